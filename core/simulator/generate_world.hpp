// SPDX-License-Identifier: Apache-2.0
// Worlds by kind and seed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/simulator/world.hpp"

namespace foretrack {

enum class WorldKind : std::uint8_t {
  kEmpty,
  kBoxes,          // 0.5–1.5 m wide, 3.5–4.5 m high
  kCylinders,      // 0.25–0.75 m radius
  kWalls,          // 2–5 m long and 0.2 m thick, between cylinders
  kBlocks,         // street blocks, 4.5 m pitch
  kTIntersection,  // a stem along x that meets a cross street along y
  kCorridor,       // a hallway along x with offset side openings
  kDoorways,       // rooms with doors 1.6 m wide
  kHedges,         // 1.3 m high, to be looked over
};
inline constexpr std::array<std::string_view, 9> kWorldKindNames = {
    "empty",          "boxes",    "cylinders", "walls", "blocks",
    "t_intersection", "corridor", "doorways",  "hedges"};

struct WorldGenerator {
  WorldKind kind = WorldKind::kEmpty;
  int count = 120;  // of shapes, for the scattered kinds; fewer if they do not fit
  std::uint64_t seed = 1;
};

/// A world by kind and seed, the same on every machine. Scattered shapes leave gaps of 1.2 m to
/// pass, and keep 1 m from the `keep_free` polyline (a point is a polyline).
World generate_world(const WorldGenerator& generator, const Vec3& min_m = Vec3(-20.0, -20.0, 0.0),
                     const Vec3& max_m = Vec3(20.0, 20.0, 5.0),
                     std::span<const Vec2> keep_free = {});

}  // namespace foretrack
