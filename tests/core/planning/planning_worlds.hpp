// SPDX-License-Identifier: Apache-2.0
// Worlds and contexts shared by the tests of the planning front end.
#pragma once

#include "core/common/random.hpp"
#include "core/planning/see/look_ahead.hpp"
#include "core/simulator/world.hpp"

namespace foretrack::testing {

inline World empty_world(double half_m = 8.0) {
  World world;
  world.min_m = {-half_m, -half_m, 0.0};
  world.max_m = {half_m, half_m, 4.0};
  return world;
}

/// Upright cylinders, none within free_m of the origin.
inline World forest(std::uint64_t seed, int count, double half_m = 8.0, double free_m = 1.0) {
  World world = empty_world(half_m);
  Random random(seed);
  while (static_cast<int>(world.cylinders.size()) < count) {
    const Vec2 center(random.uniform(-half_m, half_m), random.uniform(-half_m, half_m));
    const double radius_m = random.uniform(0.15, 0.7);
    if (center.norm() > radius_m + free_m) world.cylinders.push_back({center, radius_m, 4.0, 0.0});
  }
  return world;
}

/// A map in which everything is unknown, with free space where `is_free` says so.
template <class IsFree>
GridMap partly_known_map(const World& world, double resolution_m, IsFree&& is_free) {
  GridMap map = known_map(world, resolution_m);
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x)
        if (!is_free(map.center_of({x, y, z})))
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kUnknown);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

/// A flat context: everything at one height.
struct FlatContext {
  FlatContext(GridMap m, double height_m)
      : map(std::move(m)), surface{Vec2::Zero(), height_m, height_m, 1.0} {}
  GridMap map;
  FlightSurface surface;
  PlanningParams params;
  SearchContext context() const { return {map, surface, params, params.limits, 2.0, 0.2}; }
};

}  // namespace foretrack::testing
