// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_params.hpp"

namespace foretrack {

ParamRows rows(FleetParams& p) {
  return {
      {"silent_s", &p.silent_s, "s", 0.2, 10.0,
       "who was not heard for so long gets no seat, and is expected to stop"},
      {"forget_s", &p.forget_s, "s", 1.0, 600.0, "who was not heard for so long is gone"},
      {"near_m", &p.near_m, "m", 1.0, 5.0, "distance of the one vehicle in the band"},
      {"far_m", &p.far_m, "m", 2.0, 6.0, "wanted distance of the others"},
      {"far_least_m", &p.far_least_m, "m", 1.5, 6.0,
       "the same where there is less room; no seat where there is still less"},
      {"layer_m", &p.layer_m, "m", 0.5, 10.0,
       "from one layer to the next, of vehicles that do not hear each other"},
      {"layer_change_s", &p.layer_change_s, "s", 0.5, 30.0,
       "who is silent for so long has come to its layer"},
      {"separation_m", &p.separation_m, "m", 0.5, 10.0, "kept between two vehicles' hulls"},
      {"margin_m", &p.margin_m, "m", 0.0, 5.0, "beyond it: what vehicles leave their plans by"},
      {"yield_m", &p.yield_m, "m", 0.0, 5.0, "kept beyond it by who has to give way"},
      {"downwash_m", &p.downwash_m, "m", 0.0, 10.0,
       "height over and under a vehicle that is kept free"},
      {"replan_m_s2", &p.replan_m_s2, "m/s2", 0.0, 20.0,
       "with which another vehicle may leave the plan that it told"},
      {"replan_max_m", &p.replan_max_m, "m", 0.0, 5.0, "and how far at most until it is silent"},
      {"growth_m_s", &p.growth_m_s, "m/s", 0.0, 10.0,
       "by which the place of a silent vehicle grows"},
      {"growth_max_m", &p.growth_max_m, "m", 0.0, 20.0, "and how far at most"},
      {"gate_mahalanobis", &p.gate_mahalanobis, "1", 1.0, 10.0,
       "where another vehicle sees the person, farther from where this one does, is not believed"},
      {"liar_s", &p.liar_s, "s", 0.1, 10.0, "after so long it is called a liar"},
      {"align_memory_s", &p.align_memory_s, "s", 1.0, 600.0,
       "places of the person count so long for aligning frames"},
      {"align_yaw_rad", &p.align_yaw_rad, "rad", 0.01, 1.0,
       "a frame less surely aligned is not believed"},
      {"align_position_m", &p.align_position_m, "m", 0.01, 5.0, "the same, of places"},
      {"look_ahead_s", &p.look_ahead_s, "s", 0.5, 5.0, "what a seat would see counts so far ahead"},
      {"speed_m_s", &p.speed_m_s, "m/s", 0.5, 20.0, "with which a seat is thought to be reached"},
      {"way_weight_per_s", &p.way_weight_per_s, "1/s", 0.0, 1.0,
       "cost of a second of way, in shares of sight"},
      {"keep_weight", &p.keep_weight, "1", 0.0, 1.0, "worth of the seat that is held"},
      {"occlusion_weight", &p.occlusion_weight, "1", 0.0, 1.0,
       "cost of a vehicle in another one's line of sight"},
      {"picture_weight", &p.picture_weight, "1", 0.0, 1.0,
       "cost of a vehicle in the background of another one's picture"},
      {"spacing_weight", &p.spacing_weight, "1", 0.0, 1.0, "cost of two vehicles on one side"},
      {"by_intention", &p.by_intention, "1", 0.0, 1.0,
       "seats are given by what is seen over all intentions; else evenly"},
      {"directions", &p.directions, "1", 0.0, 1.0,
       "a seat's direction is flown to; else its distance alone"},
  };
}

}  // namespace foretrack
