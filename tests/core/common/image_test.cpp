// SPDX-License-Identifier: Apache-2.0
#include "core/common/image.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(RgbImage, PixelsLieRowByRowWithThreeBytesEach) {
  RgbImage image{3, 2, std::vector<std::uint8_t>(18)};
  for (std::size_t i = 0; i < 18; ++i) image.rgb[i] = static_cast<std::uint8_t>(i);
  const RgbImage& seen = image;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(seen.pixel(column, row)[0], 3 * (3 * row + column));
      EXPECT_EQ(image.pixel(column, row)[2], 3 * (3 * row + column) + 2);
    }
}

}  // namespace
}  // namespace foretrack
