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
  /// One copy; its rows follow each other from `first` on.
  struct Level {
    int width_log2 = 0, height_log2 = 0;
    std::size_t first = 0;  ///< index in texels
  };
  std::vector<Level> levels;  ///< the finest first, down to one texel
  std::vector<std::uint32_t> texels;
};

/// A texture of an image. Each side is brought to the nearest power of two, at most 1024. Row 0 of
/// the image is at v = 1, as OBJ files have it. Throws std::invalid_argument for an empty image.
Texture make_texture(const RgbImage& image);

/// What the simulated world is made of.
enum class Surface : std::uint8_t { kPaving, kBrick, kPlaster, kConcrete, kLeaves, kRoof };
inline constexpr int kSurfaceCount = 6;

/// Length of one repeat of each surface's texture, in both directions.
inline constexpr std::array<double, kSurfaceCount> kSurfaceTile_m = {4.0, 2.0, 4.0, 3.0, 1.5, 2.0};
/// The texture of a surface, 256 × 256 texels. It is computed, and the same on every machine.
Texture make_surface_texture(Surface surface);

}  // namespace foretrack
