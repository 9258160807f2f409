// SPDX-License-Identifier: Apache-2.0
#include "core/perception/image_region.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(ImageRegion, HasItsSidesAtZeroAndOne) {
  const ImageRegion region{{100.0, 50.0}, 40.0, 0.0};
  EXPECT_EQ(region.image_px({0.5, 0.5}), Vec2(100.0, 50.0));
  EXPECT_EQ(region.image_px({0.0, 0.0}), Vec2(80.0, 30.0));
  EXPECT_EQ(region.image_px({1.0, 0.0}), Vec2(120.0, 30.0));
  EXPECT_EQ(region.image_px({0.0, 1.0}), Vec2(80.0, 70.0));
}

TEST(ImageRegion, TurnsClockwiseInTheImage) {
  const ImageRegion region{{100.0, 50.0}, 40.0, kPi / 2.0};
  EXPECT_LT((region.image_px({0.5, 0.0}) - Vec2(120.0, 50.0)).norm(), 1e-9)
      << "what was above is to the right";
  EXPECT_LT((region.image_px({1.0, 0.5}) - Vec2(100.0, 70.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace foretrack
