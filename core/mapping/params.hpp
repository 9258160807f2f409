// SPDX-License-Identifier: Apache-2.0
// The parameters of mapping.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// What each of them means, and its range, is in its row: see rows(), or `foretrack params
/// mapping`.
struct MappingParams {
  double resolution_m = 0.15;
  double box_width_m = 15.0;
  double box_height_m = 3.6;
  double scroll_step_m = 0.75;
  // Depth images.
  double min_range_m = 0.2;
  double max_range_m = 6.0;
  int hit_columns = 320;
  int ray_columns = 80;
  // Occupancy.
  double hit_log_odds = 0.85;
  double miss_log_odds = 0.4;
  double min_log_odds = -2.0;
  double max_log_odds = 2.5;
  // What moves.
  double mover_lately_s = 1.5;
  double mover_height_m = 0.5;
  double mover_radius_m = 0.8;
  double mover_sigma_m = 0.1;
  // What is not an obstacle.
  double body_margin_m = 0.25;
  double body_moves_m_s = 0.3;
  double vehicle_bubble_m = 0.6;
  double start_bubble_m = 0.8;
  double vehicle_reach_m = 1.0;
  double start_reach_m = 1.2;
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(MappingParams& p);

}  // namespace foretrack
