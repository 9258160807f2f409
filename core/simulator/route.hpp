// SPDX-License-Identifier: Apache-2.0
// Routes with sharp turns around what stands in a world.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simulator/world.hpp"

namespace foretrack {

struct RouteRequest {
  std::uint64_t seed = 1;
  double length_m = 60.0;
  double person_radius_m = 0.3;
  double corner_reach_m = 0.45;  // how far before and after a corner the walk cuts it
};

/// A walk between places beside the shapes' corners: seeded, free for the person's radius with its
/// corners cut, each turn 50–135° (gentler only where nothing else leads on). In an empty world it
/// turns anywhere. Throws std::invalid_argument if the world has no way to walk. Cost: some
/// milliseconds for 120 shapes.
std::vector<Vec2> generate_route(const World& world, const RouteRequest& request);

/// Rounds through generate_world's T-intersection: along the stem, left or right by seed, around
/// the block and back into the stem.
std::vector<Vec2> t_intersection_route(const RouteRequest& request);

}  // namespace foretrack
