// SPDX-License-Identifier: Apache-2.0
#include "core/common/lens.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace foretrack {
namespace {

TEST(Undistort, IsTheInverseOfEachModelAllOverTheImage) {
  const CameraModel camera = CameraModel::from_fov(640, 480, rad(80), rad(64));
  const std::vector<std::pair<const char*, std::vector<double>>> lenses = {
      {"plumb_bob", {-0.28, 0.09, 0.0008, -0.0006, -0.012}},
      {"rational_polynomial", {0.4, -0.3, 0.001, 0.0005, 0.02, 0.75, -0.2, 0.01}},
      {"equidistant", {-0.02, 0.01, -0.004, 0.001}}};
  for (const auto& [name, coefficients] : lenses) {
    const Lens lens = lens_of(name, coefficients);
    for (double x = -0.8; x <= 0.8; x += 0.1)
      for (double y = -0.6; y <= 0.6; y += 0.1) {
        const auto straight = undistort(distort({x, y}, camera, lens), camera, lens);
        ASSERT_TRUE(straight) << name << " " << x << " " << y;
        EXPECT_NEAR(straight->x(), camera.fx_px * x + camera.cx_px, 1e-5) << name;
        EXPECT_NEAR(straight->y(), camera.fy_px * y + camera.cy_px, 1e-5) << name;
      }
  }
}

TEST(Undistort, FarOutsideTheLensThereIsNothing) {
  const CameraModel camera;
  const Lens lens = lens_of("plumb_bob", std::vector{-0.4, 0.0, 0.0, 0.0, 0.0});
  EXPECT_FALSE(undistort({5000.0, 240.0}, camera, lens));
}

TEST(LensOf, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(lens_of("magic", {}), std::invalid_argument);
  EXPECT_THROW(lens_of("plumb_bob", std::vector{1.0}), std::invalid_argument);
  EXPECT_THROW(lens_of("plumb_bob", std::vector{0.0, 0.0, 0.0, std::nan("")}),
               std::invalid_argument);
  EXPECT_THROW(lens_of("none", std::vector{0.1}), std::invalid_argument);
  EXPECT_THROW(lens_of("rational_polynomial", std::vector<double>(5)), std::invalid_argument);
  EXPECT_THROW(lens_of("equidistant", std::vector<double>(5)), std::invalid_argument);
  EXPECT_FALSE(lens_of("", {}).distorts());
}

TEST(LensOf, TakesWhatDriversWrite) {
  EXPECT_FALSE(lens_of("none", {}).distorts());
  EXPECT_FALSE(lens_of("none", std::vector<double>(5)).distorts());
  EXPECT_FALSE(lens_of("plumb_bob", {}).distorts());
  const std::vector<double> eight = {-0.3, 0.1, 0.0, 0.0, 0.02, 0.01, 0.0, 0.0};
  EXPECT_EQ(lens_of("plumb_bob", eight).model, Lens::Model::kRationalPolynomial);
  std::vector<double> fourteen = eight;
  fourteen.resize(14);
  EXPECT_EQ(lens_of("rational_polynomial", fourteen).coefficients[4], 0.02);
  fourteen[9] = 0.1;
  EXPECT_THROW(lens_of("rational_polynomial", fourteen), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
