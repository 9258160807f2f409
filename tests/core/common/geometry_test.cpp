// SPDX-License-Identifier: Apache-2.0
#include "core/common/geometry.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

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

TEST(Geometry, DirectionAndYawAreInverse) {
  for (double yaw = -3.1; yaw < 3.2; yaw += 0.1) {
    EXPECT_NEAR(direction_of(yaw).norm(), 1.0, 1e-12);
    EXPECT_NEAR(yaw_of(direction_of(yaw)), yaw, 1e-12);
  }
  EXPECT_EQ(direction_of(0.0), Vec2(1.0, 0.0));
}

TEST(Geometry, DegreesAndRadiansAreInverse) {
  EXPECT_DOUBLE_EQ(rad(180.0), kPi);
  for (const double angle : {-270.0, 0.0, 33.3}) EXPECT_DOUBLE_EQ(deg(rad(angle)), angle);
}

TEST(Geometry, DistanceOverTheGroundIgnoresHeight) {
  EXPECT_DOUBLE_EQ(distance_xy({1.0, 2.0, 50.0}, {4.0, -2.0, 0.0}), 5.0);
}

}  // namespace
}  // namespace foretrack
