// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/params.hpp"

namespace foretrack {

ParamRows rows(MappingParams& p) {
  return {
      {"resolution_m", &p.resolution_m, "m", 0.05, 1.0, "edge of a cell"},
      {"box_width_m", &p.box_width_m, "m", 1.0, 60.0, "of the local map around the vehicle"},
      {"box_height_m", &p.box_height_m, "m", 1.0, 20.0, "of the local map around the vehicle"},
      {"scroll_step_m", &p.scroll_step_m, "m", 0.1, 10.0,
       "the box follows when the vehicle is farther from its centre"},
      {"min_range_m", &p.min_range_m, "m", 0.0, 5.0, "nearer returns are ignored"},
      {"max_range_m", &p.max_range_m, "m", 0.5, 50.0,
       "farther returns say only that it is free to there"},
      {"hit_columns", &p.hit_columns, "1", 1, 4096, "columns of the image whose returns are used"},
      {"ray_columns", &p.ray_columns, "1", 1, 4096, "columns of the image whose rays clear"},
      {"hit_log_odds", &p.hit_log_odds, "1", 0.05, 5.0, "added where a return is"},
      {"miss_log_odds", &p.miss_log_odds, "1", 0.05, 5.0, "subtracted where a ray passes"},
      {"min_log_odds", &p.min_log_odds, "1", -6.0, -0.05, "surely free"},
      {"max_log_odds", &p.max_log_odds, "1", 0.05, 6.0, "surely occupied"},
      {"mover_lately_s", &p.mover_lately_s, "s", 0.0, 10.0,
       "what stands where it was free this short ago may move"},
      {"mover_height_m", &p.mover_height_m, "m", 0.1, 2.0, "least height of what moves"},
      {"mover_radius_m", &p.mover_radius_m, "m", 0.2, 5.0, "greatest radius of what moves"},
      {"mover_sigma_m", &p.mover_sigma_m, "m", 0.01, 1.0,
       "standard deviation of the place of what moves"},
      {"body_margin_m", &p.body_margin_m, "m", 0.0, 1.0,
       "returns this near a moving body are no obstacles"},
      {"body_moves_m_s", &p.body_moves_m_s, "m/s", 0.0, 5.0,
       "a body that is no person and slower is an obstacle"},
      {"vehicle_bubble_m", &p.vehicle_bubble_m, "m", 0.0, 3.0,
       "unknown space this near the vehicle is free"},
      {"start_bubble_m", &p.start_bubble_m, "m", 0.0, 5.0, "the same, where the vehicle starts"},
      {"vehicle_reach_m", &p.vehicle_reach_m, "m", 0.0, 5.0,
       "unknown space this near before the camera is free"},
      {"start_reach_m", &p.start_reach_m, "m", 0.0, 5.0,
       "room before the camera, where the vehicle starts"},
      {"bodies_stale_s", &p.bodies_stale_s, "s", 0.05, 5.0,
       "bodies that are further in time from an image are none"},
      {"image_stale_s", &p.image_stale_s, "s", 0.1, 60.0,
       "without an image for so long, mapping says so"},
      {"vehicle_stale_s", &p.vehicle_stale_s, "s", 0.05, 60.0,
       "an older vehicle state counts as none, and mapping says so"},
  };
}

}  // namespace foretrack
