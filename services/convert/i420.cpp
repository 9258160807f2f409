// SPDX-License-Identifier: Apache-2.0
#include "services/convert/i420.hpp"

namespace foretrack {
namespace {

// BT.601 in 1/256.
std::uint8_t brightness(const std::uint8_t* p) {
  return static_cast<std::uint8_t>(((66 * p[0] + 129 * p[1] + 25 * p[2] + 128) >> 8) + 16);
}
std::uint8_t blueness(int red, int green, int blue) {
  return static_cast<std::uint8_t>(((-38 * red - 74 * green + 112 * blue + 128) >> 8) + 128);
}
std::uint8_t redness(int red, int green, int blue) {
  return static_cast<std::uint8_t>(((112 * red - 94 * green - 18 * blue + 128) >> 8) + 128);
}

// Two rows of pixels at a time: one of colour.
void convert_rows(const std::uint8_t* upper, const std::uint8_t* lower, int width_px,
                  std::uint8_t* y_upper, std::uint8_t* y_lower, std::uint8_t* u, std::uint8_t* v) {
  for (int column = 0; column < width_px; ++column) {
    y_upper[column] = brightness(upper + 3 * column);
    y_lower[column] = brightness(lower + 3 * column);
  }
  for (int pair = 0; pair < width_px / 2; ++pair, upper += 6, lower += 6) {
    const auto mean = [&](int c) {
      return (upper[c] + upper[c + 3] + lower[c] + lower[c + 3] + 2) / 4;
    };
    u[pair] = blueness(mean(0), mean(1), mean(2));
    v[pair] = redness(mean(0), mean(1), mean(2));
  }
}

}  // namespace

void to_i420(const RgbImage& image, I420Image& out) {
  const int width_px = image.width_px / 2 * 2, height_px = image.height_px / 2 * 2;
  out.width_px = width_px;
  out.height_px = height_px;
  out.bytes.resize(static_cast<std::size_t>(width_px) * height_px * 3 / 2);
  for (int row = 0; row < height_px; row += 2)
    convert_rows(image.pixel(0, row), image.pixel(0, row + 1), width_px, out.y() + row * width_px,
                 out.y() + (row + 1) * width_px, out.u() + row / 2 * (width_px / 2),
                 out.v() + row / 2 * (width_px / 2));
}

}  // namespace foretrack
