// SPDX-License-Identifier: Apache-2.0
// Worlds by kind and seed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/simulator/world.hpp"

namespace foretrack {

/// What stands in a world.
enum class WorldKind : std::uint8_t {
  kEmpty,
  kBoxes,          ///< 0.5–1.5 m wide, 3.5–4.5 m high
  kCylinders,      ///< 0.25–0.75 m radius
  kWalls,          ///< 2–5 m long and 0.2 m thick, between cylinders
  kBlocks,         ///< street blocks, 4.5 m from one to the next
  kTIntersection,  ///< a stem along x that meets a street along y at the origin
  kCorridor,       ///< a hallway along x with openings to both sides
  kDoorways,       ///< rooms of 6 m with doors 1.6 m wide
  kHedges,         ///< 1.3 m high, to be looked over
};
/// As scenario files have them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 9> kWorldKindNames = {
    "empty",          "boxes",    "cylinders", "walls", "blocks",
    "t_intersection", "corridor", "doorways",  "hedges"};

/// Which world is wanted.
struct WorldGenerator {
  WorldKind kind = WorldKind::kEmpty;
  int count = 120;  ///< of shapes, for the scattered kinds; fewer if they do not fit
  std::uint64_t seed = 1;
};

/// A world of a kind within bounds. The same seed gives the same world on every machine. Scattered
/// shapes leave gaps of 1.2 m to pass. All shapes keep 1 m from the polyline `keep_free` (one point
/// is a polyline too); those that would not are left out. Cost: some milliseconds for 120 shapes.
World generate_world(const WorldGenerator& generator, const Vec3& min_m = Vec3(-20.0, -20.0, 0.0),
                     const Vec3& max_m = Vec3(20.0, 20.0, 5.0),
                     std::span<const Vec2> keep_free = {});

}  // namespace foretrack
