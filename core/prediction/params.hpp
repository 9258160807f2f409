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
  double horizon_s = 3.0;
  double step_s = 0.2;
  bool intention_paths = true;
  bool around_obstacles = true;
  bool short_term_network = true;
  double path_probability_min = 0.05;
  // Reachable region
  double region_horizon_s = 1.0;
  double region_min_radius_m = 1.0;
  int region_rays_per_side = 12;
  double region_ahead_s = 0.5;
  double obstacle_range_m = 5.0;
  double obstacle_floor_m = 0.3;
  // Scores
  double k1_turn_potential = 3.0;
  double k2_turn_observation = 2.0;
  double k3_decelerate_potential = 0.3;
  double k4_decelerate_observation = 3.0;
  double k4_forward_potential = 1.0;
  double k5_forward_observation = 1.0;
  double b0_sensitivity = 1.0;
  double b1_forward_potential = 1.0;
  double b2_forward_observation = 1.0;
  double walking_speed_m_s = 0.2;
  double speed_fall_interval_s = 0.4;
  // Motion models
  double turn_rate_rad_s = 3.5;
  double max_turn_rad = 2.2;
  double min_turn_rad = kPi / 6.0;
  double min_turn_way_m = 0.8;
  double deceleration_m_s2 = 2.0;
  double target_radius_m = 0.3;
  // Search
  int max_expansions = 150;
  double max_cost = 20.0;
  double goal_weight = 1.0;
  double eagerness = 0.25;

  int step_count() const { return static_cast<int>(horizon_s / step_s + 0.5); }
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(PredictionParams& params);

}  // namespace foretrack
