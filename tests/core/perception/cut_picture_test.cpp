// SPDX-License-Identifier: Apache-2.0
#include "core/perception/cut_picture.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// Grey; the right half is white.
RgbImage half_white(int width_px, int height_px) {
  RgbImage image;
  image.width_px = width_px;
  image.height_px = height_px;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      for (int c = 0; c < 3; ++c) image.rgb.push_back(x < width_px / 2 ? 100 : 255);
  return image;
}

TEST(CutPicture, ShowsTheBoxAndALittleAround) {
  const RgbImage cut = cut_picture(half_white(200, 100), {90, 20}, {110, 40}, 200);
  EXPECT_EQ(cut.width_px, 24);
  EXPECT_EQ(cut.height_px, 24);
  EXPECT_EQ(cut.pixel(0, 0)[0], 100);
  EXPECT_EQ(cut.pixel(23, 23)[2], 255);
}

TEST(CutPicture, IsNoLargerThanItMayBe) {
  const RgbImage cut = cut_picture(half_white(600, 400), {0, 0}, {600, 400}, 60);
  EXPECT_EQ(cut.width_px, 60);
  EXPECT_EQ(cut.height_px, 40);
  EXPECT_EQ(cut.rgb.size(), 3u * 60u * 40u);
  EXPECT_EQ(cut.pixel(0, 0)[1], 100);
  EXPECT_EQ(cut.pixel(59, 39)[1], 255);
}

TEST(CutPicture, WhatIsOutsideOfTheImageIsLeftOut) {
  const RgbImage cut = cut_picture(half_white(100, 100), {-50, -50}, {10, 10}, 100);
  EXPECT_EQ(cut.width_px, 16);
  EXPECT_EQ(cut.height_px, 16);
  EXPECT_TRUE(cut_picture(half_white(100, 100), {200, 200}, {210, 220}, 50).rgb.empty());
  EXPECT_TRUE(cut_picture(half_white(100, 100), {20, 20}, {10, 10}, 50).rgb.empty());
  EXPECT_TRUE(
      cut_picture(half_white(100, 100), Vec2::Constant(std::nan("")), {9, 9}, 50).rgb.empty());
  EXPECT_TRUE(cut_picture({}, {0, 0}, {9, 9}, 50).rgb.empty());
}

}  // namespace
}  // namespace foretrack
