// SPDX-License-Identifier: Apache-2.0
// Mazes of straight passages: bends, junctions and dead ends, as indoors.
#pragma once

#include <vector>

#include "core/simulator/world.hpp"

namespace foretrack::bench {

struct Passages {
  World world;
  std::vector<Vec2> route_m;
};

/// Passages on a lattice, open along a random route and at some other places, so that some corners
/// leave one way to go and others a choice. Everything else is wall.
Passages generate_passages(std::uint64_t seed);

}  // namespace foretrack::bench
