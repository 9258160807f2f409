// SPDX-License-Identifier: Apache-2.0
#include "core/common/frames.hpp"

#include <gtest/gtest.h>

#include "core/common/camera.hpp"
#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"

namespace foretrack {
namespace {

Quat random_attitude(Random& random) {
  return Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

TEST(Frames, NorthInEnuIsTheFirstAxisOfNed) {
  EXPECT_EQ(swap_enu_ned({0, 1, 0}), Vec3(1, 0, 0));   // north
  EXPECT_EQ(swap_enu_ned({1, 0, 0}), Vec3(0, 1, 0));   // east
  EXPECT_EQ(swap_enu_ned({0, 0, 1}), Vec3(0, 0, -1));  // up
}

TEST(Frames, LeftInFluIsNegativeRightInFrd) {
  EXPECT_EQ(swap_flu_frd({1, 2, 3}), Vec3(1, -2, -3));
}

TEST(Frames, YawEastInEnuIsNinetyDegreesInNed) {
  EXPECT_NEAR(swap_yaw_enu_ned(0.0), kPi / 2.0, 1e-12);
  EXPECT_NEAR(swap_yaw_enu_ned(kPi / 2.0), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(swap_yaw_enu_ned(-kPi / 2.0)), kPi, 1e-12);
  EXPECT_EQ(swap_yaw_rate_enu_ned(0.5), -0.5);
}

TEST(Frames, EverySwapIsItsOwnInverse) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3 v(random.normal(), random.normal(), random.normal());
    EXPECT_EQ(swap_enu_ned(swap_enu_ned(v)), v);
    EXPECT_EQ(swap_flu_frd(swap_flu_frd(v)), v);
    const double yaw = random.uniform(-kPi, kPi);
    EXPECT_NEAR(wrap_angle(swap_yaw_enu_ned(swap_yaw_enu_ned(yaw)) - yaw), 0.0, 1e-12);
    const Quat q = random_attitude(random);
    EXPECT_LT(swap_attitude_enu_ned(swap_attitude_enu_ned(q)).angularDistance(q), 1e-7);
  }
}

TEST(Frames, AttitudeSwapMapsTheSamePhysicalVector) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Quat q_enu_flu = random_attitude(random);
    const Vec3 body_flu(random.normal(), random.normal(), random.normal());
    const Vec3 expected_ned = swap_enu_ned(q_enu_flu * body_flu);
    const Vec3 ned = swap_attitude_enu_ned(q_enu_flu) * swap_flu_frd(body_flu);
    EXPECT_LT((ned - expected_ned).norm(), 1e-12);
  }
}

TEST(Frames, AttitudeFacingNorthIsIdentityInNed) {
  const Quat north(Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()));
  EXPECT_LT(swap_attitude_enu_ned(north).angularDistance(Quat::Identity()), 1e-12);
}

TEST(Frames, OpticalAxisIsBodyForward) {
  const Mat3 r = flu_from_optical();
  EXPECT_EQ(r * Vec3::UnitZ(), Vec3::UnitX());
  EXPECT_EQ(r * Vec3::UnitX(), Vec3(0, -1, 0));
  EXPECT_EQ(r * Vec3::UnitY(), Vec3(0, 0, -1));
  EXPECT_NEAR(r.determinant(), 1.0, 1e-15);
}

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

TEST(Geometry, WrappedAngleIsTheSameDirectionWithinHalfATurn) {
  for (double angle = -20.0; angle < 20.0; angle += 0.137) {
    const double wrapped = wrap_angle(angle);
    EXPECT_LE(std::abs(wrapped), kPi + 1e-12);
    EXPECT_LT((direction_of(wrapped) - direction_of(angle)).norm(), 1e-12);
    EXPECT_NEAR(wrap_angle(yaw_of(direction_of(angle)) - angle), 0.0, 1e-12);
  }
}

TEST(Geometry, YawOfAnAttitudeIgnoresPitch) {
  const Quat q =
      Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(-0.3, Vec3::UnitY()));
  EXPECT_NEAR(yaw_of(q), 0.7, 1e-12);
}

}  // namespace
}  // namespace foretrack
