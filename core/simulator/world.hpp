// SPDX-License-Identifier: Apache-2.0
// A world of boxes and upright cylinders: exact rays and distances, and its voxel map.
#pragma once

#include <vector>

#include "core/common/grid_map.hpp"

namespace foretrack {

/// Axis-aligned, world ENU.
struct Box {
  Vec3 min_m = Vec3::Zero();
  Vec3 max_m = Vec3::Zero();
};

/// Upright, from base_m to base_m + height_m.
struct Cylinder {
  Vec2 center_m = Vec2::Zero();
  double radius_m = 0.5;
  double height_m = 4.0;
  double base_m = 0.0;
};

/// What is really there. The ground at min_m.z() is not a shape: only depth cameras and the bounds
/// know it.
struct World {
  Vec3 min_m = Vec3(-20.0, -20.0, 0.0);
  Vec3 max_m = Vec3(20.0, 20.0, 5.0);
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;

  bool contains(const Vec3& p) const {
    return (p.array() >= min_m.array()).all() && (p.array() <= max_m.array()).all();
  }
};

/// Distance along the unit direction to the shape: 0 from inside, infinity if it is missed. Exact.
double ray_distance_m(const Box& box, const Vec3& from_enu_m, const Vec3& direction);
double ray_distance_m(const Cylinder& cylinder, const Vec3& from_enu_m, const Vec3& direction);

/// Distance from the point to the shape's surface, negative inside. Exact.
double signed_distance_m(const Box& box, const Vec3& point_enu_m);
double signed_distance_m(const Cylinder& cylinder, const Vec3& point_enu_m);

/// Distance to the first shape, at most range_m (range_m: none). Cost: linear in the shapes.
double ray_distance_m(const World& world, const Vec3& from_enu_m, const Vec3& direction,
                      double range_m);

/// True if no shape touches the segment.
bool line_of_sight(const World& world, const Vec3& from_enu_m, const Vec3& to_enu_m);

/// Distance to the nearest shape, negative inside one; infinity in an empty world. The ground and
/// the bounds are not counted.
double clearance_m(const World& world, const Vec3& point_enu_m);

/// Distance on the ground plane from a point (or a walked line) to the nearest shape that reaches
/// below height_m.
double ground_clearance_m(const World& world, const Vec2& point_m, double height_m = 2.0);
double ground_clearance_m(const World& world, const Vec2& from_m, const Vec2& to_m,
                          double height_m = 2.0);

/// A cell is occupied if it overlaps a shape, else free; the grid covers the bounds. Distances are
/// filled. Cost: about 30 ms for 40 × 40 × 5 m at 0.15 m, mostly the distance transform.
GridMap known_map(const World& world, double resolution_m);

}  // namespace foretrack
