// SPDX-License-Identifier: Apache-2.0
// Pictures that move, for what encodes them.
#pragma once

#include <cmath>

#include "core/common/image.hpp"

namespace foretrack::testing {

/// A street that passes by: smooth walls with edges, and somebody in red in front of it.
inline RgbImage street(double shift_px, int width = 320, int height = 240) {
  RgbImage out{width, height, std::vector<std::uint8_t>(3ul * width * height)};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double x = column + shift_px;
      const bool wall = std::sin(x / 40.0) > 0.3 && row > height / 4;
      const double light = 110 + 60 * std::sin(x / 25.0) * std::cos(row / 18.0) + (wall ? 40 : 0);
      const bool person = std::abs(column - width / 2) < 20 && row > height / 3;
      std::uint8_t* to = out.pixel(column, row);
      to[0] = static_cast<std::uint8_t>(person ? 200 : light);
      to[1] = static_cast<std::uint8_t>(person ? 40 : light);
      to[2] = static_cast<std::uint8_t>(person ? 50 : 0.8 * light);
    }
  return out;
}

}  // namespace foretrack::testing
