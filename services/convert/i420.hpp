// SPDX-License-Identifier: Apache-2.0
// Pictures as video encoders take them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/image.hpp"

namespace foretrack {

/// Brightness (Y) of each pixel, then blueness (U) and redness (V) of each two by two: BT.601,
/// limited range. Width and height are even.
struct I420Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> bytes;  ///< 3 / 2 × width × height

  std::uint8_t* y() { return bytes.data(); }
  std::uint8_t* u() { return y() + width_px * height_px; }
  std::uint8_t* v() { return u() + width_px * height_px / 4; }
};

/// Of an odd width or height the last column or row is left out. `out` keeps its memory. Cost:
/// about 0.5 ms for 640 × 480 pixels.
void to_i420(const RgbImage& image, I420Image& out);

}  // namespace foretrack
