// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/world.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The part [enter, leave] of a ray that is between two parallel planes on an axis.
struct Interval {
  double enter = 0.0;
  double leave = kInfinity;
  void clip(double from, double direction, double low, double high) {
    if (std::abs(direction) < 1e-12) {
      if (from < low || from > high) leave = -kInfinity;
      return;
    }
    const double a = (low - from) / direction, b = (high - from) / direction;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  double distance() const { return enter <= leave ? enter : kInfinity; }
};

// Distance outside and depth inside, from the excess over each face (Quilez's box formula).
double combine(double excess_xy, double excess_z) {
  const double outside = std::hypot(std::max(excess_xy, 0.0), std::max(excess_z, 0.0));
  return outside > 0.0 ? outside : std::max(excess_xy, excess_z);
}

double segment_distance_m(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double u = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - u * ab).norm();
}

// Distance from the segment ab to an axis-aligned rectangle; 0 if they touch.
double rectangle_distance_m(const Box& box, const Vec2& a, const Vec2& b) {
  Interval hit;
  hit.leave = 1.0;
  for (int axis = 0; axis < 2; ++axis)
    hit.clip(a[axis], b[axis] - a[axis], box.min_m[axis], box.max_m[axis]);
  if (hit.enter <= hit.leave) return 0.0;
  double nearest = kInfinity;
  for (const Vec2& p : {a, b}) {
    const Vec2 inside = p.cwiseMax(box.min_m.head<2>()).cwiseMin(box.max_m.head<2>());
    nearest = std::min(nearest, (p - inside).norm());
  }
  for (const double x : {box.min_m.x(), box.max_m.x()})
    for (const double y : {box.min_m.y(), box.max_m.y()})
      nearest = std::min(nearest, segment_distance_m({x, y}, a, b));
  return nearest;
}

struct CellRange {
  Eigen::Vector3i low, high;
};

CellRange cells_of(const GridMap& map, const Vec3& min_m, const Vec3& max_m) {
  const Vec3 slack = Vec3::Constant(1e-9);
  return {map.index_of(min_m + slack).cwiseMax(Eigen::Vector3i::Zero()),
          map.index_of(max_m - slack).cwiseMin(map.size - Eigen::Vector3i::Ones())};
}

template <class Overlaps>
void fill(GridMap& map, const CellRange& range, Overlaps&& overlaps) {
  for (int y = range.low.y(); y <= range.high.y(); ++y)
    for (int x = range.low.x(); x <= range.high.x(); ++x) {
      if (!overlaps(x, y)) continue;
      for (int z = range.low.z(); z <= range.high.z(); ++z)
        map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
    }
}

void fill(GridMap& map, const Cylinder& cylinder) {
  const Vec3 reach(cylinder.radius_m, cylinder.radius_m, 0.0);
  const Vec3 base(cylinder.center_m.x(), cylinder.center_m.y(), cylinder.base_m);
  const auto range = cells_of(map, base - reach, base + reach + cylinder.height_m * Vec3::UnitZ());
  fill(map, range, [&](int x, int y) {
    const Vec2 low = map.origin_enu_m.head<2>() + map.resolution_m * Vec2(x, y);
    const Vec2 nearest =
        cylinder.center_m.cwiseMax(low).cwiseMin(low + Vec2::Constant(map.resolution_m));
    return (nearest - cylinder.center_m).norm() < cylinder.radius_m - 1e-9;
  });
}

}  // namespace

double ray_distance_m(const Box& box, const Vec3& from, const Vec3& direction) {
  Interval hit;
  for (int axis = 0; axis < 3; ++axis)
    hit.clip(from[axis], direction[axis], box.min_m[axis], box.max_m[axis]);
  return hit.distance();
}

double ray_distance_m(const Cylinder& cylinder, const Vec3& from, const Vec3& direction) {
  Interval hit;
  hit.clip(from.z(), direction.z(), cylinder.base_m, cylinder.base_m + cylinder.height_m);
  // |offset + t·d|² = r² on the ground plane.
  const Vec2 offset = from.head<2>() - cylinder.center_m, d = direction.head<2>();
  const double a = d.squaredNorm(), b = offset.dot(d);
  const double c = offset.squaredNorm() - cylinder.radius_m * cylinder.radius_m;
  if (a < 1e-18) return c <= 0.0 ? hit.distance() : kInfinity;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return kInfinity;
  const double root = std::sqrt(discriminant);
  hit.enter = std::max(hit.enter, (-b - root) / a);
  hit.leave = std::min(hit.leave, (-b + root) / a);
  return hit.distance();
}

double signed_distance_m(const Box& box, const Vec3& p) {
  const Vec3 excess = (box.min_m - p).cwiseMax(p - box.max_m);
  const double inside_xy = excess.head<2>().maxCoeff();
  const double outside_xy = excess.head<2>().cwiseMax(0.0).norm();
  return combine(outside_xy > 0.0 ? outside_xy : inside_xy, excess.z());
}

double signed_distance_m(const Cylinder& cylinder, const Vec3& p) {
  const double excess_xy = (p.head<2>() - cylinder.center_m).norm() - cylinder.radius_m;
  const double excess_z =
      std::max(cylinder.base_m - p.z(), p.z() - cylinder.base_m - cylinder.height_m);
  return combine(excess_xy, excess_z);
}

double ray_distance_m(const World& world, const Vec3& from, const Vec3& direction, double range_m) {
  double nearest = range_m;
  for (const auto& box : world.boxes)
    nearest = std::min(nearest, ray_distance_m(box, from, direction));
  for (const auto& cylinder : world.cylinders)
    nearest = std::min(nearest, ray_distance_m(cylinder, from, direction));
  return nearest;
}

bool line_of_sight(const World& world, const Vec3& from, const Vec3& to) {
  const double length_m = (to - from).norm();
  if (length_m < 1e-9) return clearance_m(world, from) > 0.0;
  return ray_distance_m(world, from, (to - from) / length_m, kInfinity) > length_m;
}

double clearance_m(const World& world, const Vec3& point) {
  double nearest = kInfinity;
  for (const auto& box : world.boxes) nearest = std::min(nearest, signed_distance_m(box, point));
  for (const auto& cylinder : world.cylinders)
    nearest = std::min(nearest, signed_distance_m(cylinder, point));
  return nearest;
}

double ground_clearance_m(const World& world, const Vec2& point, double height_m) {
  return ground_clearance_m(world, point, point, height_m);
}

double ground_clearance_m(const World& world, const Vec2& from, const Vec2& to, double height_m) {
  double nearest = kInfinity;
  for (const auto& box : world.boxes)
    if (box.min_m.z() < height_m) nearest = std::min(nearest, rectangle_distance_m(box, from, to));
  for (const auto& cylinder : world.cylinders)
    if (cylinder.base_m < height_m)
      nearest = std::min(nearest, std::max(0.0, segment_distance_m(cylinder.center_m, from, to) -
                                                    cylinder.radius_m));
  return nearest;
}

GridMap known_map(const World& world, double resolution_m) {
  if (!(resolution_m > 0.0))
    throw std::invalid_argument("known_map: resolution_m must be greater than 0");
  GridMap map;
  map.resolution_m = resolution_m;
  map.origin_enu_m = world.min_m;
  const Vec3 extent = (world.max_m - world.min_m) / resolution_m;
  map.size = (extent.array() - 1e-9).ceil().cast<int>();
  map.cells.assign(map.cell_count(), static_cast<std::uint8_t>(Cell::kFree));
  for (const auto& box : world.boxes)
    fill(map, cells_of(map, box.min_m, box.max_m), [](int, int) { return true; });
  for (const auto& cylinder : world.cylinders) fill(map, cylinder);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

}  // namespace foretrack
