// SPDX-License-Identifier: Apache-2.0
// Every number that the prediction stage may be tuned by. What belongs to one intention is in its
// file (intentions/).
#pragma once

#include "core/common/geometry.hpp"
#include "core/common/params.hpp"

namespace foretrack {

/// Names follow the paper (§III.B, §III.C, §IV); "ours" marks what it does not have.
struct PredictionParams {
  // Prediction
  double horizon_s = 3.0;  ///< how far ahead paths reach, T_p
  double step_s = 0.2;     ///< time between predicted states, Δ
  /// a path for each intention; else one of constant velocity unless blocked
  bool intention_paths = true;
  /// paths lead around obstacles; else one of constant velocity whatever stands there
  bool around_obstacles = true;
  bool short_term_network = true;      ///< who tells the next moment, where all paths begin
  double path_probability_min = 0.05;  ///< less likely paths are left out, all but the likeliest
  double target_stale_s = 0.5;  ///< without a target state for so long, nobody is expected anywhere
  // Reachable region
  double region_horizon_s = 1.0;     ///< what the reachable region covers
  double region_min_radius_m = 1.0;  ///< its least radius
  int region_rays_per_side = 12;     ///< rays over 90 degrees
  double region_ahead_s = 0.5;       ///< t0: how early a corner is noticed
  double obstacle_range_m = 5.0;     ///< obstacles beyond do not count
  double obstacle_floor_m = 0.3;     ///< least d_obs in R_dec
  // Scores
  double k1_turn_potential = 3.0;          ///< gain of R_tl, R_tr
  double k2_turn_observation = 2.0;        ///< gain of O_tl, O_tr
  double k3_decelerate_potential = 0.3;    ///< gain of R_dec
  double k4_decelerate_observation = 3.0;  ///< gain of O_dec
  double k4_forward_potential = 1.0;       ///< gain in R_cv
  double k5_forward_observation = 1.0;     ///< gain in O_cv
  double b0_sensitivity = 1.0;             ///< score threshold b0
  double b1_forward_potential = 1.0;       ///< b1 in R_cv
  double b2_forward_observation = 1.0;     ///< b2 in O_cv
  double walking_speed_m_s = 0.2;          ///< below it the velocity has no direction
  double speed_fall_interval_s = 0.4;      ///< Δt of O_dec
  // Motion models
  double turn_rate_rad_s = 3.5;     ///< ω of a turn
  double max_turn_rad = 2.2;        ///< a turn goes straight after this
  double min_turn_rad = kPi / 6.0;  ///< less is not a turn
  double min_turn_way_m = 0.8;      ///< a turn must lead this far from the present course
  double deceleration_m_s2 = 2.0;   ///< a of slowing down
  double target_radius_m = 0.3;     ///< kept clear of obstacles
  // Search
  int max_expansions = 150;  ///< bound of the work per intention
  double max_cost = 20.0;    ///< costlier paths are not considered
  double goal_weight = 1.0;  ///< w_h
  double eagerness = 0.25;   ///< cost of a step not yet taken: less search, later detours

  int step_count() const { return static_cast<int>(horizon_s / step_s + 0.5); }
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(PredictionParams& params);

}  // namespace foretrack
