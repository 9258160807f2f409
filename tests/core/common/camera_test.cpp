// SPDX-License-Identifier: Apache-2.0
#include "core/common/camera.hpp"

#include <gtest/gtest.h>

#include "core/common/vehicle.hpp"

namespace foretrack {
namespace {

TEST(Camera, FieldOfViewRoundTrips) {
  const CameraModel camera = CameraModel::from_fov(320, 240, rad(90.0), rad(75.0));
  EXPECT_NEAR(camera.horizontal_fov_rad(), rad(90.0), 1e-12);
  EXPECT_NEAR(camera.vertical_fov_rad(), rad(75.0), 1e-12);
  EXPECT_NEAR(CameraModel().vertical_fov_rad(), rad(75.0), 1e-3);
}

TEST(Camera, EdgeOfViewIsEdgeOfImage) {
  const CameraModel camera = CameraModel::from_fov(320, 240, rad(90.0), rad(75.0));
  const Vec2 corner = *camera.project({std::tan(rad(45.0)), std::tan(rad(37.5)), 1.0});
  EXPECT_LT((corner - Vec2(320, 240)).norm(), 1e-9);
  EXPECT_FALSE(camera.contains(corner));
  EXPECT_TRUE(camera.contains(corner - Vec2(0.5, 0.5)));
}

TEST(Camera, PointBehindHasNoImage) {
  EXPECT_FALSE(CameraModel().project({0.1, 0.1, -1.0}).has_value());
  EXPECT_FALSE(CameraModel().project({0.0, 0.0, 0.0}).has_value());
}

TEST(Camera, PointLeftOfTheVehicleIsLeftInTheImage) {
  VehicleState vehicle;
  vehicle.position_enu_m = {1, 2, 3};
  vehicle.q_world_body = Quat(Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()));  // faces north
  const Pose T_world_camera = vehicle.T_world_body() * CameraModel().T_body_camera;
  const Vec3 north_west_up(1 - 0.5, 2 + 2.0, 3 + 0.4);
  const Vec2 px = *CameraModel().project(T_world_camera.inverse() * north_west_up);
  EXPECT_NEAR(px.x(), 320.0 - 320.0 * 0.25, 1e-9);
  EXPECT_NEAR(px.y(), 240.0 - 312.78 * 0.2, 1e-9);
}

TEST(Camera, APointIsOnTheRayOfItsImagePoint) {
  const CameraModel camera = CameraModel::from_fov(800, 600, rad(80.0), rad(62.0));
  for (const double depth_m : {0.5, 3.0, 40.0})
    for (const double across : {-0.7, 0.0, 0.4}) {
      const Vec3 point = depth_m * Vec3(across, 0.5 * across - 0.1, 1.0);
      const auto px = camera.project(point);
      ASSERT_TRUE(px);
      EXPECT_NEAR((px->x() - camera.cx_px) / camera.fx_px, across, 1e-12);
      EXPECT_NEAR((px->y() - camera.cy_px) / camera.fy_px, 0.5 * across - 0.1, 1e-12);
    }
}

TEST(Camera, TheImageHoldsItsFirstPixelAndEndsBeforeItsSize) {
  const CameraModel camera;
  EXPECT_TRUE(camera.contains({0.0, 0.0}));
  EXPECT_TRUE(camera.contains({639.9, 479.9}));
  EXPECT_FALSE(camera.contains({640.0, 100.0}));
  EXPECT_FALSE(camera.contains({100.0, 480.0}));
  EXPECT_FALSE(camera.contains({-0.1, 100.0}));
}

}  // namespace
}  // namespace foretrack
