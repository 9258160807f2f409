// SPDX-License-Identifier: Apache-2.0
#include "core/common/ground.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kBeside_m = 0.75;  // half the width of what may be ground

// Of whatever is below.
std::optional<double> top_below_m(const GridMap& map, const Vec3& point_enu_m) {
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

}  // namespace

// What falls away on both sides is narrow. A slope or a step falls away on one.
std::optional<double> ground_below_m(const GridMap& map, const Vec3& point_enu_m) {
  std::optional<double> ground_m = top_below_m(map, point_enu_m);
  if (!ground_m) return {};
  for (const Vec3& side : {Vec3(kBeside_m, 0.0, 0.0), Vec3(0.0, kBeside_m, 0.0)}) {
    const std::optional<double> one = top_below_m(map, point_enu_m - side);
    const std::optional<double> other = top_below_m(map, point_enu_m + side);
    if (one && other) ground_m = std::min(*ground_m, std::max(*one, *other));
  }
  return ground_m;
}

}  // namespace foretrack
