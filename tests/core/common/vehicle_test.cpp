// SPDX-License-Identifier: Apache-2.0
#include "core/common/vehicle.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace foretrack {
namespace {

VehicleState state_at(double stamp_s) {
  VehicleState s;
  s.stamp_s = stamp_s;
  s.position_enu_m = Vec3(1.0, -2.0, 0.5) * stamp_s;
  s.velocity_enu_m_s = Vec3(2.0 * stamp_s, 0.0, 0.0);
  s.q_world_body = Quat(Eigen::AngleAxisd(0.8 * stamp_s, Vec3::UnitZ()));
  s.angular_velocity_body_rad_s = Vec3(0.0, 0.0, stamp_s);
  return s;
}

TEST(VehicleHistory, IsEmptyBeforeTheFirstState) {
  EXPECT_FALSE(VehicleHistory().at(0.0).has_value());
  EXPECT_EQ(VehicleHistory().newest(), nullptr);
}

TEST(VehicleHistory, InterpolatesBetweenStates) {
  VehicleHistory history;
  for (int k = 0; k <= 10; ++k) history.add(state_at(0.1 * k));
  for (double t = 0.0; t <= 1.0; t += 0.013) {
    const auto s = history.at(t);
    ASSERT_TRUE(s.has_value());
    EXPECT_NEAR(s->stamp_s, t, 1e-12);
    EXPECT_LT((s->position_enu_m - state_at(t).position_enu_m).norm(), 1e-12);
    EXPECT_LT((s->velocity_enu_m_s - state_at(t).velocity_enu_m_s).norm(), 1e-12);
    EXPECT_NEAR(s->yaw_rad(), 0.8 * t, 1e-9);
    EXPECT_NEAR(s->angular_velocity_body_rad_s.z(), t, 1e-12);
  }
}

TEST(VehicleHistory, TakesTheShortWayAroundHalfATurn) {
  VehicleHistory history;
  VehicleState a = state_at(0.0), b = state_at(1.0);
  a.q_world_body = Quat(Eigen::AngleAxisd(rad(170.0), Vec3::UnitZ()));
  b.q_world_body = Quat(Eigen::AngleAxisd(rad(-170.0), Vec3::UnitZ()));
  history.add(a);
  history.add(b);
  EXPECT_NEAR(std::abs(history.at(0.5)->yaw_rad()), kPi, 1e-9);
}

TEST(VehicleHistory, HoldsTheEndsOnlyWithinTheSlack) {
  VehicleHistory history;
  history.add(state_at(1.0));
  history.add(state_at(2.0));
  EXPECT_EQ(history.at(2.04, 0.05)->position_enu_m, state_at(2.0).position_enu_m);
  EXPECT_EQ(history.at(0.96, 0.05)->position_enu_m, state_at(1.0).position_enu_m);
  EXPECT_FALSE(history.at(2.06, 0.05).has_value());
  EXPECT_FALSE(history.at(0.94, 0.05).has_value());
}

TEST(VehicleHistory, DropsTheOldestAndStaysInOrderWhenFull) {
  VehicleHistory history(8);
  for (int k = 0; k <= 20; ++k) history.add(state_at(k));
  EXPECT_FALSE(history.at(12.0).has_value());
  for (double t = 13.0; t <= 20.0; t += 0.21)
    EXPECT_LT((history.at(t)->position_enu_m - state_at(t).position_enu_m).norm(), 1e-9);
  EXPECT_EQ(history.newest()->stamp_s, 20.0);
}

TEST(VehicleHistory, IgnoresStatesThatAreNotNewer) {
  VehicleHistory history;
  history.add(state_at(1.0));
  VehicleState again = state_at(1.0);
  again.position_enu_m.setConstant(99.0);
  history.add(again);
  history.add(state_at(0.5));
  EXPECT_EQ(history.newest()->position_enu_m, state_at(1.0).position_enu_m);
  EXPECT_FALSE(history.at(0.5).has_value());
}

TEST(VehicleHistory, ACopyHoldsAsManyStatesAsTheOriginal) {
  const VehicleHistory empty(4);
  VehicleHistory copy = empty;
  for (int k = 0; k < 6; ++k) copy.add({.stamp_s = 1.0 * k});
  EXPECT_TRUE(copy.at(2.0, 0.0)) << "four states are kept";
  EXPECT_FALSE(copy.at(1.0, 0.0));
  VehicleHistory again = copy;
  again.add({.stamp_s = 6.0});
  EXPECT_EQ(again.newest()->stamp_s, 6.0);
  EXPECT_TRUE(again.at(3.0, 0.0));
  EXPECT_FALSE(again.at(2.0, 0.0));
}

TEST(VehicleHistory, HoldsAtLeastOneState) {
  VehicleHistory history(0);
  history.add({.stamp_s = 1.0});
  history.add({.stamp_s = 2.0});
  EXPECT_EQ(history.newest()->stamp_s, 2.0);
}

TEST(VehicleHistory, AtNoTimeThereIsNoState) {
  VehicleHistory history;
  history.add({.stamp_s = 1.0});
  history.add({.stamp_s = 2.0});
  EXPECT_FALSE(history.at(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace foretrack
