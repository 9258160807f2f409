// SPDX-License-Identifier: Apache-2.0
// The parameters of mapping.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params mapping`.
struct MappingParams {
  double resolution_m = 0.15;   ///< edge of a cell
  double box_width_m = 15.0;    ///< of the local map around the vehicle
  double box_height_m = 3.6;    ///< of the local map around the vehicle
  double scroll_step_m = 0.75;  ///< the box follows when the vehicle is farther from its centre
  // Depth images.
  double min_range_m = 0.2;  ///< nearer returns are ignored
  double max_range_m = 6.0;  ///< farther returns say only that it is free to there
  int hit_columns = 320;     ///< columns of the image whose returns are used
  int ray_columns = 80;      ///< columns of the image whose rays clear
  // Occupancy.
  double hit_log_odds = 0.85;  ///< added where a return is
  double miss_log_odds = 0.4;  ///< subtracted where a ray passes
  double min_log_odds = -2.0;  ///< surely free
  double max_log_odds = 2.5;   ///< surely occupied
  // What moves.
  double mover_lately_s = 1.5;  ///< what stands where it was free this short ago may move
  double mover_height_m = 0.5;  ///< least height of what moves
  double mover_radius_m = 0.8;  ///< greatest radius of what moves
  double mover_sigma_m = 0.1;   ///< standard deviation of the place of what moves
  // What is not an obstacle.
  double body_margin_m = 0.25;    ///< returns this near a moving body are no obstacles
  double body_moves_m_s = 0.3;    ///< a body that is no person and slower is an obstacle
  double vehicle_bubble_m = 0.6;  ///< unknown space this near the vehicle is free
  double start_bubble_m = 0.8;    ///< the same, where the vehicle starts
  double vehicle_reach_m = 1.0;   ///< unknown space this near before the camera is free
  double start_reach_m = 1.2;     ///< room before the camera, where the vehicle starts
  // What is too old.
  double bodies_stale_s = 0.6;   ///< bodies that are further in time from an image are none
  double image_stale_s = 1.0;    ///< without an image for so long, mapping says so
  double vehicle_stale_s = 1.0;  ///< an older vehicle state counts as none, and mapping says so
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(MappingParams& p);

}  // namespace foretrack
