// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/ground.hpp"

namespace foretrack {

std::optional<double> ground_below_m(const GridMap& map, const Vec3& point_enu_m) {
  Eigen::Vector3i cell = map.index_of(point_enu_m);
  if (!map.contains(cell)) return {};
  for (; cell.z() >= 0; --cell.z()) {
    const Cell is = static_cast<Cell>(map.cells[map.offset_of(cell)]);
    if (is == Cell::kUnknown) return {};
    if (is == Cell::kOccupied) return map.origin_enu_m.z() + map.resolution_m * (cell.z() + 1);
  }
  if (map.stamp_s == 0.0) return map.origin_enu_m.z();
  return {};
}

}  // namespace foretrack
