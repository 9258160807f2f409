// SPDX-License-Identifier: Apache-2.0
#include "core/perception/shrink_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace foretrack {
namespace {

struct PixelShare {
  int begin, end;
};

// Of `count` pixels those that become pixel i of `shrunk`. Never empty.
PixelShare share_of(int i, int shrunk, int count) {
  const auto edge = [&](int k) {
    return static_cast<int>(static_cast<std::int64_t>(k) * count / shrunk);
  };
  return {edge(i), std::max(edge(i) + 1, edge(i + 1))};
}

void put_mean(const RgbImage& image, PixelShare columns, PixelShare rows, std::uint8_t* to) {
  unsigned sum[3] = {};
  for (int row = rows.begin; row < rows.end; ++row) {
    const std::uint8_t* from = image.pixel(columns.begin, row);
    for (int column = columns.begin; column < columns.end; ++column, from += 3)
      for (int c = 0; c < 3; ++c) sum[c] += from[c];
  }
  const unsigned count = (columns.end - columns.begin) * (rows.end - rows.begin);
  for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
}

}  // namespace

void shrink(const RgbImage& image, int width_px, RgbImage& out) {
  out.width_px = std::min(image.width_px, width_px);
  if (out.width_px == image.width_px) {
    out.height_px = image.height_px;
    out.rgb = image.rgb;
    return;
  }
  const double scale = static_cast<double>(out.width_px) / std::max(1, image.width_px);
  out.height_px = std::max(1, static_cast<int>(std::lround(scale * image.height_px)));
  out.rgb.resize(3 * static_cast<std::size_t>(out.width_px) * out.height_px);
  for (int row = 0; row < out.height_px; ++row)
    for (int column = 0; column < out.width_px; ++column)
      put_mean(image, share_of(column, out.width_px, image.width_px),
               share_of(row, out.height_px, image.height_px), out.pixel(column, row));
}

}  // namespace foretrack
