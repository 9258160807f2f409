// SPDX-License-Identifier: Apache-2.0
// The parameters of a fleet's coordination.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params fleet`.
struct FleetParams {
  double silent_s = 1.0;   ///< who was not heard for so long gets no seat, and is expected to stop
  double forget_s = 15.0;  ///< who was not heard for so long is gone
  double near_m = 2.0;     ///< distance of the one vehicle in the band
  double far_m = 3.5;      ///< wanted distance of the others
  /// the same where there is less room; no seat where there is still less
  double far_least_m = 2.6;
  double layer_m = 1.8;  ///< from one layer to the next, of vehicles that do not hear each other
  double layer_change_s = 4.0;  ///< who is silent for so long has come to its layer
  double separation_m = 1.0;    ///< kept between two vehicles' hulls
  double margin_m = 0.15;       ///< beyond it: what vehicles leave their plans by
  double yield_m = 0.3;         ///< kept beyond it by who has to give way
  double downwash_m = 2.0;      ///< height over and under a vehicle that is kept free
  double replan_m_s2 = 5.0;     ///< with which another vehicle may leave the plan that it told
  double replan_max_m = 0.9;    ///< and how far at most until it is silent
  double growth_m_s = 1.0;      ///< by which the place of a silent vehicle grows
  double growth_max_m = 0.75;   ///< and how far at most
  /// where another vehicle sees the person, farther from where this one does, is not believed
  double gate_mahalanobis = 4.0;
  double liar_s = 1.0;             ///< after so long it is called a liar
  double align_memory_s = 20.0;    ///< places of the person count so long for aligning frames
  double align_yaw_rad = 0.1;      ///< a frame less surely aligned is not believed
  double align_position_m = 0.3;   ///< the same, of places
  double look_ahead_s = 2.5;       ///< what a seat would see counts so far ahead
  double speed_m_s = 2.5;          ///< with which a seat is thought to be reached
  double way_weight_per_s = 0.02;  ///< cost of a second of way, in shares of sight
  double keep_weight = 0.04;       ///< worth of the seat that is held
  double occlusion_weight = 0.3;   ///< cost of a vehicle in another one's line of sight
  double picture_weight = 0.02;    ///< cost of a vehicle in the background of another one's picture
  double spacing_weight = 0.05;    ///< cost of two vehicles on one side
  bool by_intention = true;  ///< seats are given by what is seen over all intentions; else evenly
  bool directions = true;    ///< a seat's direction is flown to; else its distance alone
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(FleetParams& p);

}  // namespace foretrack
