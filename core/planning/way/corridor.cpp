// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/corridor.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr std::size_t kPlanesMax = 32;
constexpr double kTouch_m = 1e-3;  // planes keep this far from the segment

struct Segment {
  Segment(const Vec3& from, const Vec3& to) : origin(from), length_m((to - from).norm()) {
    direction = length_m > 1e-9 ? Vec3((to - from) / length_m) : Vec3::Zero();
  }
  Vec3 closest_to(const Vec3& p) const {
    return origin + std::clamp((p - origin).dot(direction), 0.0, length_m) * direction;
  }
  Vec3 end() const { return origin + length_m * direction; }
  Vec3 origin, direction;
  double length_m;
};

struct CellRange {
  Eigen::Vector3i low, high;  // both included
};

Vec3 closest_in_cell(const Vec3& center, double half_m, const Vec3& p) {
  return p.cwiseMax(center - Vec3::Constant(half_m)).cwiseMin(center + Vec3::Constant(half_m));
}

// Bounds of the polytope: a box along the segment, and the part of the map that is known.
CellRange add_bounds(const GridMap& map, const Segment& segment, const CorridorParams& params,
                     Polytope& polytope) {
  const Vec2 along_xy = segment.direction.head<2>();
  const Vec2 u = along_xy.norm() > 1e-3 ? Vec2(along_xy.normalized()) : Vec2(1.0, 0.0);
  const Vec3 end = segment.end();
  Vec3 low = segment.origin, high = segment.origin;
  const auto add = [&](const Vec3& axis, double reach_m) {
    const double highest = std::max(axis.dot(segment.origin), axis.dot(end));
    polytope.planes.emplace_back(axis.x(), axis.y(), axis.z(), highest + reach_m);
  };
  for (const double side : {1.0, -1.0}) {
    add(side * Vec3(u.x(), u.y(), 0.0), params.reach_m);
    add(side * Vec3(-u.y(), u.x(), 0.0), params.reach_m);
    add(side * Vec3::UnitZ(), params.height_m);
  }
  const Vec3 reach(std::hypot(params.reach_m, params.reach_m) * Vec3::Ones());
  low = segment.origin.cwiseMin(end) - reach;
  high = segment.origin.cwiseMax(end) + reach;
  low.z() = std::min(segment.origin.z(), end.z()) - params.height_m;
  high.z() = std::max(segment.origin.z(), end.z()) + params.height_m;
  const Vec3 map_low = map.origin_enu_m + Vec3::Constant(params.vehicle_radius_m);
  const Vec3 map_high = map.origin_enu_m + map.resolution_m * map.size.cast<double>() -
                        Vec3::Constant(params.vehicle_radius_m);
  for (int a = 0; a < 3; ++a) {
    if (high[a] > map_high[a]) {
      const double bound = std::max({map_high[a], segment.origin[a] + kTouch_m, end[a] + kTouch_m});
      polytope.planes.emplace_back(a == 0, a == 1, a == 2, bound);
    }
    if (low[a] < map_low[a]) {
      const double bound = std::min({map_low[a], segment.origin[a] - kTouch_m, end[a] - kTouch_m});
      polytope.planes.emplace_back(-(a == 0), -(a == 1), -(a == 2), -bound);
    }
  }
  return {map.index_of(low).cwiseMax(0),
          map.index_of(high).cwiseMin(map.size - Eigen::Vector3i::Ones())};
}

// Cells that the vehicle's centre may not enter and that have a neighbour which it may.
void collect_blocked(const GridMap& map, const CellRange& range, const Segment& segment,
                     const Polytope& bounds, double radius_m, CorridorWorkspace& workspace) {
  const int required_cm = static_cast<int>(std::ceil(100.0 * radius_m - 1e-6));
  const std::ptrdiff_t dy = map.size.x(), dz = dy * map.size.y();
  const double half_m = 0.5 * map.resolution_m;
  workspace.blocked.clear();
  for (int z = range.low.z(); z <= range.high.z(); ++z)
    for (int y = range.low.y(); y <= range.high.y(); ++y) {
      const std::uint8_t* row = map.unfree_distance_cm.data() + map.offset_of({0, y, z});
      for (int x = range.low.x(); x <= range.high.x(); ++x) {
        const std::uint8_t* cell = row + x;
        if (*cell >= required_cm) continue;
        const bool surface = (x > range.low.x() && cell[-1] >= required_cm) ||
                             (x < range.high.x() && cell[1] >= required_cm) ||
                             (y > range.low.y() && cell[-dy] >= required_cm) ||
                             (y < range.high.y() && cell[dy] >= required_cm) ||
                             (z > range.low.z() && cell[-dz] >= required_cm) ||
                             (z < range.high.z() && cell[dz] >= required_cm);
        if (!surface) continue;
        const Vec3 center = map.center_of({x, y, z});
        if (!bounds.contains(center, map.resolution_m)) continue;
        const Vec3 first = closest_in_cell(center, half_m, segment.closest_to(center));
        const Vec3 q = segment.closest_to(first);
        const Vec3 nearest = closest_in_cell(center, half_m, q);
        workspace.blocked.push_back({center, nearest, (nearest - q).squaredNorm()});
      }
    }
}

struct Separation {
  bool apart = false;  // there is a plane between the segment and the cell
  Eigen::Vector4d plane = Eigen::Vector4d::Zero();  // zero: the segment runs through the centre
};

// The half-space that ends at the cell's nearest point; at the segment if the cell touches it.
Separation separate(const Segment& segment, const CorridorWorkspace::Blocked& cell) {
  Separation result;
  Vec3 normal = cell.nearest - segment.closest_to(cell.nearest);
  result.apart = normal.norm() > kTouch_m;
  if (!result.apart) normal = cell.center - segment.closest_to(cell.center);
  const double length_m = normal.norm();
  if (length_m < 1e-9) return result;
  normal /= length_m;
  const double highest = std::max(normal.dot(segment.origin), normal.dot(segment.end()));
  const double offset = result.apart ? normal.dot(cell.nearest) : highest;
  result.plane << normal, std::max(offset, highest + kTouch_m);
  return result;
}

}  // namespace

void resize_polytopes(CorridorWorkspace& workspace, std::vector<Polytope>& polytopes,
                      std::size_t count) {
  while (polytopes.size() > count) {
    workspace.spare.push_back(std::move(polytopes.back()));
    polytopes.pop_back();
  }
  while (polytopes.size() < count) {
    if (workspace.spare.empty()) {
      workspace.spare.emplace_back();
      workspace.spare.back().planes.reserve(2 * kPlanesMax);
    }
    polytopes.push_back(std::move(workspace.spare.back()));
    workspace.spare.pop_back();
  }
}

bool decompose_segment(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m,
                       const CorridorParams& params, CorridorWorkspace& workspace,
                       Polytope& polytope) {
  const Segment segment(from_enu_m, to_enu_m);
  polytope.planes.clear();
  const CellRange range = add_bounds(map, segment, params, polytope);
  collect_blocked(map, range, segment, polytope, params.vehicle_radius_m, workspace);
  auto& blocked = workspace.blocked;
  bool clear = true;
  const double half_m = 0.5 * map.resolution_m;
  while (!blocked.empty() && polytope.planes.size() < kPlanesMax) {
    const auto nearest =
        std::min_element(blocked.begin(), blocked.end(),
                         [](const auto& a, const auto& b) { return a.squared_m2 < b.squared_m2; });
    const Separation cut = separate(segment, *nearest);
    clear &= cut.apart;
    *nearest = blocked.back();
    blocked.pop_back();
    if (cut.plane.isZero()) continue;
    polytope.planes.push_back(cut.plane);
    const double support_m = half_m * cut.plane.head<3>().cwiseAbs().sum() - kTouch_m;
    std::erase_if(blocked, [&](const auto& cell) {
      return cut.plane.head<3>().dot(cell.center) - support_m >= cut.plane[3];
    });
  }
  return clear && blocked.empty();
}

}  // namespace foretrack
