// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/params.hpp"

namespace foretrack {
double PredictionParams::change_cost(Intention from, Intention to) const {
  if (from == to) return 0.0;
  if (is_turn(from) && is_turn(to)) return change_turn_opposite;
  if (from == Intention::kForward)
    return is_turn(to) ? change_forward_turn : change_forward_decelerate;
  if (from == Intention::kDecelerate)
    return is_turn(to) ? change_decelerate_turn : change_decelerate_forward;
  return to == Intention::kForward ? change_turn_forward : change_turn_decelerate;
}

double PredictionParams::noise_m2_s3(Intention intention) const {
  if (intention == Intention::kForward) return forward_noise_m2_s3;
  return is_turn(intention) ? turn_noise_m2_s3 : decelerate_noise_m2_s3;
}

ParamRows rows(PredictionParams& p) {
  return {
      {"horizon_s", &p.horizon_s, "s", 0.2, 10.0, "how far ahead paths reach, T_p"},
      {"step_s", &p.step_s, "s", 0.05, 1.0, "time between predicted states, Δ"},
      {"intention_paths", &p.intention_paths, "", 0, 0,
       "a path for each intention; else one of constant velocity unless blocked"},
      {"around_obstacles", &p.around_obstacles, "", 0, 0,
       "paths lead around obstacles; else one of constant velocity whatever stands there"},
      {"path_probability_min", &p.path_probability_min, "", 0.0, 0.25,
       "less likely paths are left out, all but the likeliest"},
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
      {"change_forward_turn", &p.change_forward_turn, "", 0.0, 100.0, "Λ(forward, turn)"},
      {"change_turn_forward", &p.change_turn_forward, "", 0.0, 100.0, "Λ(turn, forward)"},
      {"change_turn_opposite", &p.change_turn_opposite, "", 0.0, 100.0, "Λ(turn, other turn)"},
      {"change_forward_decelerate", &p.change_forward_decelerate, "", 0.0, 100.0,
       "Λ(forward, decelerate)"},
      {"change_decelerate_forward", &p.change_decelerate_forward, "", 0.0, 100.0,
       "Λ(decelerate, forward)"},
      {"change_turn_decelerate", &p.change_turn_decelerate, "", 0.0, 100.0, "Λ(turn, decelerate)"},
      {"change_decelerate_turn", &p.change_decelerate_turn, "", 0.0, 100.0, "Λ(decelerate, turn)"},
      {"forward_noise_m2_s3", &p.forward_noise_m2_s3, "m^2/s^3", 0.0, 10.0,
       "how the covariance of going forward grows"},
      {"turn_noise_m2_s3", &p.turn_noise_m2_s3, "m^2/s^3", 0.0, 10.0, "of turning"},
      {"decelerate_noise_m2_s3", &p.decelerate_noise_m2_s3, "m^2/s^3", 0.0, 10.0,
       "of slowing down"},
  };
}

}  // namespace foretrack
