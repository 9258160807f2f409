// SPDX-License-Identifier: Apache-2.0
#include "core/perception/search_window.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace foretrack {
namespace {

RgbImage picture(int width_px, int height_px) {
  RgbImage image{width_px, height_px, {}};
  image.rgb.resize(3u * width_px * height_px);
  return image;
}

bool holds(const ImageRegion& window, const Vec2& low, const Vec2& high) {
  const Vec2 reach = Vec2::Constant(0.5 * window.size_px);
  return ((window.centre_px - reach).array() <= low.array()).all() &&
         ((window.centre_px + reach).array() >= high.array()).all();
}

TEST(SearchWindow, LooksAtTheWholeImageFirst) {
  const auto window = search_window(picture(640, 480), std::nullopt, 0);
  ASSERT_TRUE(window);
  EXPECT_TRUE(holds(*window, {0, 0}, {640, 480}));
  EXPECT_EQ(window->size_px, 640.0);
}

TEST(SearchWindow, OneRoundShowsEverybodyTwiceAsLarge) {
  const RgbImage image = picture(640, 480);
  constexpr double kBody_px = 150.0;
  for (double x = 0.25 * kBody_px; x < 640 - 0.25 * kBody_px; x += 10)
    for (double y = 0.5 * kBody_px; y < 480 - 0.5 * kBody_px; y += 10) {
      const Vec2 reach(0.2 * kBody_px, 0.5 * kBody_px);
      bool seen = false;
      for (int look = 1; look < kMostWindows; ++look) {
        const auto window = search_window(image, std::nullopt, look);
        seen = seen ||
               (window->size_px <= 320.0 && holds(*window, Vec2(x, y) - reach, Vec2(x, y) + reach));
      }
      ASSERT_TRUE(seen) << x << ", " << y;
    }
}

TEST(SearchWindow, TheExpectedPlaceIsLookedAtCloseUpWithItsGate) {
  const ExpectedPlace place{{500.0, 200.0}, 40.0, 100.0};
  for (int look = 0; look < kMostWindows; ++look) {
    const auto window = search_window(picture(640, 480), place, look);
    ASSERT_TRUE(window);
    EXPECT_EQ(window->centre_px, place.torso_px);
    EXPECT_TRUE(holds(*window, {410.0, 110.0}, {590.0, 290.0}));
    EXPECT_LE(window->size_px, 250.0);
  }
}

TEST(SearchWindow, AWideGateIsLookedAtInParts) {
  const ExpectedPlace place{{320.0, 240.0}, 220.0, 60.0};
  EXPECT_EQ(search_window(picture(640, 480), place, 0)->size_px, 500.0);
  EXPECT_EQ(search_window(picture(640, 480), place, 1)->size_px, 250.0);
}

TEST(SearchWindow, NobodyIsLookedForWhoMustBeOutsideTheImage) {
  EXPECT_FALSE(search_window(picture(640, 480), ExpectedPlace{{-200.0, 240.0}, 100.0, 90.0}, 0));
  EXPECT_TRUE(search_window(picture(640, 480), ExpectedPlace{{-90.0, 240.0}, 100.0, 90.0}, 0));
}

TEST(SearchWindow, EveryWindowOfAnyImageSeesSomeOfIt) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2000, 10}, {480, 640}, {16384, 1}})
    for (int look = 0; look < 2 * kMostWindows; ++look) {
      const auto window = search_window(picture(width, height), std::nullopt, look);
      ASSERT_TRUE(window);
      EXPECT_GT(window->size_px, 0.0);
      EXPECT_LT(std::abs(window->centre_px.y() - 0.5 * height), 0.5 * (window->size_px + height));
    }
}

TEST(SearchWindow, APlaceThatOnlyTouchesTheImageIsNotLookedAt) {
  for (const ExpectedPlace& place :
       {ExpectedPlace{{-40.0, 100.0}, 40.0, 0.0}, ExpectedPlace{{0.0, 100.0}, 0.0, 0.0},
        ExpectedPlace{{640.0, 480.0}, 0.0, 0.0}})
    for (int look = 0; look < kMostWindows; ++look)
      EXPECT_FALSE(search_window(picture(640, 480), place, look));
}

}  // namespace
}  // namespace foretrack
