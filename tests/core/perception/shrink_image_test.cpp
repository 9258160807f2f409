// SPDX-License-Identifier: Apache-2.0
#include "core/perception/shrink_image.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace foretrack {
namespace {

RgbImage ramp(int width, int height) {
  RgbImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    for (const int value : {i % width, i / width, 7})
      image.rgb.push_back(static_cast<std::uint8_t>(value));
  return image;
}

TEST(ShrinkImageTest, APixelIsTheMeanOfThoseThatItTakesThePlaceOf) {
  RgbImage out;
  shrink(ramp(80, 40), 20, out);
  ASSERT_EQ(out.width_px, 20);
  ASSERT_EQ(out.height_px, 10);
  // Columns 12 to 15 and rows 8 to 11, halves rounded up.
  EXPECT_EQ(out.pixel(3, 2)[0], 14);
  EXPECT_EQ(out.pixel(3, 2)[1], 10);
  EXPECT_EQ(out.pixel(3, 2)[2], 7);
}

TEST(ShrinkImageTest, AnImageThatIsNotWiderStaysAsItIs) {
  const RgbImage image = ramp(31, 17);
  RgbImage out;
  shrink(image, 640, out);
  EXPECT_EQ(out.width_px, 31);
  EXPECT_EQ(out.height_px, 17);
  EXPECT_EQ(out.rgb, image.rgb);
}

TEST(ShrinkImageTest, EachPixelCountsOnceAlsoWhereTheSizesDoNotDivide) {
  RgbImage white{101, 53, std::vector<std::uint8_t>(3 * 101 * 53, 255)}, out;
  shrink(white, 64, out);
  EXPECT_EQ(out.height_px, 34);
  for (const auto value : out.rgb) ASSERT_EQ(value, 255);
}

TEST(ShrinkImageTest, AStripKeepsARow) {
  RgbImage out;
  shrink(ramp(200, 1), 10, out);
  EXPECT_EQ(out.height_px, 1);
}

}  // namespace
}  // namespace foretrack
