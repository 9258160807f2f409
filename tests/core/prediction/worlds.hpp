// SPDX-License-Identifier: Apache-2.0
// Small worlds of boxes, as exact boxes and as the grid that prediction reads, and targets in them.
#pragma once

#include <vector>

#include "core/common/grid_map.hpp"
#include "core/common/target.hpp"

namespace foretrack::testing {

struct Box {
  double x_min_m, x_max_m, y_min_m, y_max_m;
};

/// Walls from the floor to above the head, in a 16 m × 16 m area around the origin.
inline GridMap map_of(const std::vector<Box>& boxes) {
  GridMap map;
  map.resolution_m = 0.1;
  map.size = {160, 160, 10};
  map.origin_enu_m = Vec3(-8.0, -8.0, 0.7);
  map.cells.assign(map.cell_count(), 0);
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const Vec3 p = map.center_of({x, y, z});
        for (const Box& b : boxes)
          if (p.x() > b.x_min_m && p.x() < b.x_max_m && p.y() > b.y_min_m && p.y() < b.y_max_m)
            map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
      }
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

inline GridMap open_field() {
  return map_of({});
}
/// A corridor along x, 2 m wide, which turns to the left (+y) before a wall at x = 2 m.
inline GridMap left_corner() {
  return map_of({{-8, 0, 1, 8}, {-8, 8, -8, -1}, {2, 8, -8, 8}});
}
/// A corridor along x, 2 m wide, with a branch to the left (+y) between x = 0 and x = 2 m.
inline GridMap left_branch() {
  return map_of({{-8, 0, 1, 8}, {-8, 8, -8, -1}, {2, 8, 1, 8}});
}
/// A corridor along x, 1.6 m wide: too narrow to turn in.
inline GridMap narrow_corridor() {
  return map_of({{-8, 8, 0.8, 8}, {-8, 8, -8, -0.8}});
}

inline TargetState walker(const Vec2& position_m, const Vec2& velocity_m_s, double stamp_s = 1.0) {
  TargetState target;
  target.stamp_s = stamp_s;
  target.status = TrackStatus::kTracking;
  target.position_enu_m << position_m, 1.2;
  target.velocity_enu_m_s << velocity_m_s, 0.0;
  target.covariance = Mat6::Identity() * 0.01;
  target.body_yaw_rad = yaw_of(velocity_m_s);
  target.last_measurement_s = stamp_s;
  return target;
}

}  // namespace foretrack::testing
