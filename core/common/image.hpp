// SPDX-License-Identifier: Apache-2.0
// A colour image, as the pose network reads it and the simulated camera renders it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace foretrack {

/// Rows from the top, three bytes a pixel (red, green, blue), no padding between rows.
struct RgbImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 × width × height

  /// The three bytes of a pixel. Preconditions: 0 ≤ column < width, 0 ≤ row < height; not checked.
  const std::uint8_t* pixel(int column, int row) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(row) * width_px + column);
  }
  /// The same, to be written to.
  std::uint8_t* pixel(int column, int row) {
    return rgb.data() + 3 * (static_cast<std::size_t>(row) * width_px + column);
  }
};

}  // namespace foretrack
