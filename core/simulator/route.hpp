// SPDX-License-Identifier: Apache-2.0
// Routes with sharp turns around what stands in a world.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simulator/world.hpp"

namespace foretrack {

/// What a route is to be like.
struct RouteRequest {
  std::uint64_t seed = 1;
  double length_m = 60.0;        ///< at least, if the world allows it
  double person_radius_m = 0.3;  ///< room to both sides
  double corner_reach_m = 0.45;  ///< how far before and after a corner the walk cuts it
};

/// A polyline on the ground between places beside the shapes' corners. It is free for the person's
/// radius, also where corners are cut. Each turn is 50–135°, gentler only where nothing else leads
/// on. In an empty world it turns anywhere. The same seed gives the same route. Throws
/// std::invalid_argument if the world has no way to walk. Cost: some milliseconds for 120 shapes.
std::vector<Vec2> generate_route(const World& world, const RouteRequest& request);

/// Rounds through the T-intersection that generate_world() makes: along the stem, then to the left
/// or to the right by the seed, around the block and back into the stem.
std::vector<Vec2> t_intersection_route(const RouteRequest& request);

}  // namespace foretrack
