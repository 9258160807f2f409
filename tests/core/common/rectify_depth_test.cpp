// SPDX-License-Identifier: Apache-2.0
#include "core/common/rectify_depth.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

CameraWithLens barrel() {
  return {CameraModel::from_fov(160, 120, rad(80), rad(64)),
          lens_of("plumb_bob", std::vector{-0.25, 0.05, 0.0, 0.0, 0.0})};
}

TEST(RectifyDepth, WithoutDistortionEveryPixelStays) {
  CameraWithLens camera = barrel();
  camera.lens = {};
  const PixelMap map = straightening(camera);
  for (std::size_t i = 0; i < map.size(); ++i) ASSERT_EQ(map[i], static_cast<int>(i));
}

// Depth that grows to the right by the ray's own tangent: a plane at an angle.
TEST(RectifyDepth, APlaneIsFlatAgain) {
  const CameraWithLens camera = barrel();
  const auto depth_of = [](double tangent) { return static_cast<float>(3.0 + tangent); };
  std::vector<float> distorted, straight;
  for (int row = 0; row < 120; ++row)
    for (int column = 0; column < 160; ++column) {
      const auto px = undistort({column + 0.5, row + 0.5}, camera.camera, camera.lens);
      ASSERT_TRUE(px);
      distorted.push_back(depth_of((px->x() - camera.camera.cx_px) / camera.camera.fx_px));
    }
  rectify_depth(straightening(camera), distorted, straight);
  ASSERT_EQ(straight.size(), distorted.size());
  double worst_before = 0.0;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const double tangent =
        (static_cast<double>(i % 160) + 0.5 - camera.camera.cx_px) / camera.camera.fx_px;
    ASSERT_NEAR(straight[i], depth_of(tangent), 0.02) << i;  // of a pixel, 0.01 wide
    worst_before = std::max(worst_before, std::abs(1.0 * distorted[i] - depth_of(tangent)));
  }
  EXPECT_GT(worst_before, 0.1);
}

TEST(RectifyDepth, WhatEndsOutsideHasNoReturn) {
  CameraWithLens camera = barrel();
  camera.lens = lens_of("plumb_bob", std::vector{0.3, 0.0, 0.0, 0.0, 0.0});  // a pincushion
  std::vector<float> straight;
  rectify_depth(straightening(camera), std::vector<float>(160 * 120, 2.0F), straight);
  EXPECT_EQ(straight.front(), 0.0F);
  EXPECT_EQ(straight[60 * 160 + 80], 2.0F);
}

}  // namespace
}  // namespace foretrack
