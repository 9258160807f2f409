// SPDX-License-Identifier: Apache-2.0
#include "services/convert/i420.hpp"

#include <gtest/gtest.h>

namespace foretrack::testing {
namespace {

RgbImage plain(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  RgbImage out{2, 2, {}};
  for (int i = 0; i < 4; ++i) out.rgb.insert(out.rgb.end(), {red, green, blue});
  return out;
}

std::vector<int> yuv_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  I420Image out;
  to_i420(plain(red, green, blue), out);
  return {out.y()[0], out.u()[0], out.v()[0]};
}

// The values that BT.601 gives for them, in limited range.
TEST(I420Test, ColoursAreThoseOfBt601) {
  EXPECT_EQ(yuv_of(0, 0, 0), (std::vector{16, 128, 128}));
  EXPECT_EQ(yuv_of(255, 255, 255), (std::vector{235, 128, 128}));
  EXPECT_EQ(yuv_of(255, 0, 0), (std::vector{82, 90, 240}));
  EXPECT_EQ(yuv_of(0, 255, 0), (std::vector{144, 54, 34}));
  EXPECT_EQ(yuv_of(0, 0, 255), (std::vector{41, 240, 110}));
}

TEST(I420Test, EachPixelKeepsItsBrightnessAndFourShareAColour) {
  RgbImage image = plain(0, 0, 0);
  for (int c = 0; c < 3; ++c) image.pixel(1, 0)[c] = 255;
  image.pixel(0, 1)[0] = 255;
  I420Image out;
  to_i420(image, out);
  EXPECT_EQ(out.bytes.size(), 6u);
  EXPECT_EQ((std::vector<int>{out.y()[0], out.y()[1], out.y()[2], out.y()[3]}),
            (std::vector{16, 235, 82, 16}));
  EXPECT_NEAR(out.v()[0], 128 + (240 - 128) / 4, 1);
}

TEST(I420Test, OfAnOddSizeTheLastRowAndColumnAreLeftOut) {
  I420Image out;
  to_i420({3, 5, std::vector<std::uint8_t>(45, 100)}, out);
  EXPECT_EQ(out.width_px, 2);
  EXPECT_EQ(out.height_px, 4);
  EXPECT_EQ(out.bytes.size(), 12u);
}

}  // namespace
}  // namespace foretrack::testing
