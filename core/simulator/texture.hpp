// SPDX-License-Identifier: Apache-2.0
// Pictures on surfaces, and those that the simulated world is made of.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/common/image.hpp"

namespace foretrack {

/// A picture that repeats, with its halved copies (mip levels) so that it does not flicker from
/// afar. Sides are powers of two. A texel is red | green << 8 | blue << 16.
struct Texture {
  struct Level {
    int width_log2 = 0, height_log2 = 0;
    std::size_t first = 0;  // in texels
  };
  std::vector<Level> levels;  // the finest first
  std::vector<std::uint32_t> texels;
};

/// The sides are brought to powers of two. Row 0 of the image is at v = 1, as OBJ files have it.
/// Throws std::invalid_argument for an empty image.
Texture make_texture(const RgbImage& image);

enum class Surface : std::uint8_t { kPaving, kBrick, kPlaster, kConcrete, kLeaves, kRoof };
inline constexpr int kSurfaceCount = 6;

/// Procedural, the same on every machine; one repeat covers kSurfaceTile_m.
inline constexpr std::array<double, kSurfaceCount> kSurfaceTile_m = {4.0, 2.0, 4.0, 3.0, 1.5, 2.0};
Texture make_surface_texture(Surface surface);

}  // namespace foretrack
