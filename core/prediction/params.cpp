// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/params.hpp"

namespace foretrack {

ParamRows rows(PredictionParams& p) {
  return {
      {"horizon_s", &p.horizon_s, "s", 0.2, 10.0, "how far ahead paths reach, T_p"},
      {"step_s", &p.step_s, "s", 0.05, 1.0, "time between predicted states, Δ"},
      {"intention_paths", &p.intention_paths, "", 0, 0,
       "a path for each intention; else one of constant velocity unless blocked"},
      {"around_obstacles", &p.around_obstacles, "", 0, 0,
       "paths lead around obstacles; else one of constant velocity whatever stands there"},
      {"short_term", &p.short_term_network, "filter|network", 0, 0,
       "who tells the next moment, where all paths begin"},
      {"path_probability_min", &p.path_probability_min, "", 0.0, 0.25,
       "less likely paths are left out, all but the likeliest"},
      {"target_stale_s", &p.target_stale_s, "s", 0.05, 10.0,
       "without a target state for so long, nobody is expected anywhere"},
      {"region_horizon_s", &p.region_horizon_s, "s", 0.1, 5.0, "what the reachable region covers"},
      {"region_min_radius_m", &p.region_min_radius_m, "m", 0.1, 10.0, "its least radius"},
      {"region_rays_per_side", &p.region_rays_per_side, "", 2, 90, "rays over 90 degrees"},
      {"region_ahead_s", &p.region_ahead_s, "s", 0.0, 3.0, "t0: how early a corner is noticed"},
      {"obstacle_range_m", &p.obstacle_range_m, "m", 0.5, 50.0, "obstacles beyond do not count"},
      {"obstacle_floor_m", &p.obstacle_floor_m, "m", 0.01, 5.0, "least d_obs in R_dec"},
      {"k1_turn_potential", &p.k1_turn_potential, "1/rad", 0.0, 100.0, "gain of R_tl, R_tr"},
      {"k2_turn_observation", &p.k2_turn_observation, "1/rad", 0.0, 100.0, "gain of O_tl, O_tr"},
      {"k3_decelerate_potential", &p.k3_decelerate_potential, "s^2/m", 0.0, 100.0, "gain of R_dec"},
      {"k4_decelerate_observation", &p.k4_decelerate_observation, "s/m", 0.0, 100.0,
       "gain of O_dec"},
      {"k4_forward_potential", &p.k4_forward_potential, "", 0.0, 100.0, "gain in R_cv"},
      {"k5_forward_observation", &p.k5_forward_observation, "", 0.0, 100.0, "gain in O_cv"},
      {"b0_sensitivity", &p.b0_sensitivity, "", -10.0, 10.0, "score threshold b0"},
      {"b1_forward_potential", &p.b1_forward_potential, "", -10.0, 10.0, "b1 in R_cv"},
      {"b2_forward_observation", &p.b2_forward_observation, "", -10.0, 10.0, "b2 in O_cv"},
      {"walking_speed_m_s", &p.walking_speed_m_s, "m/s", 0.01, 2.0,
       "below it the velocity has no direction"},
      {"speed_fall_interval_s", &p.speed_fall_interval_s, "s", 0.05, 1.0, "Δt of O_dec"},
      {"turn_rate_rad_s", &p.turn_rate_rad_s, "rad/s", 0.05, 6.0, "ω of a turn"},
      {"max_turn_rad", &p.max_turn_rad, "rad", 0.1, 3.2, "a turn goes straight after this"},
      {"min_turn_rad", &p.min_turn_rad, "rad", 0.05, 3.2, "less is not a turn"},
      {"min_turn_way_m", &p.min_turn_way_m, "m", 0.0, 10.0,
       "a turn must lead this far from the present course"},
      {"deceleration_m_s2", &p.deceleration_m_s2, "m/s^2", 0.05, 10.0, "a of slowing down"},
      {"target_radius_m", &p.target_radius_m, "m", 0.0, 2.0, "kept clear of obstacles"},
      {"max_expansions", &p.max_expansions, "", 1, 100000, "bound of the work per intention"},
      {"max_cost", &p.max_cost, "", 0.1, 1000.0, "costlier paths are not considered"},
      {"goal_weight", &p.goal_weight, "1/m", 0.0, 100.0, "w_h"},
      {"eagerness", &p.eagerness, "", 0.0, 10.0,
       "cost of a step not yet taken: less search, later detours"},
  };
}

}  // namespace foretrack
