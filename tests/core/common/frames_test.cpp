// SPDX-License-Identifier: Apache-2.0
#include "core/common/frames.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

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

}  // namespace
}  // namespace foretrack
