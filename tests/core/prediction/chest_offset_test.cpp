// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/chest_offset.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using testing::walker;

constexpr double kStep_s = 0.03;

// What is believed of a chest that points chest_rad(t) for somebody whose course is course_rad(t).
double offset_of(const std::function<double(double)>& course_rad,
                 const std::function<double(double)>& chest_rad, double duration_s,
                 double speed_m_s = 1.5) {
  ChestOffset offset;
  MotionHistory history;
  Vec2 position_m = Vec2::Zero();
  for (double t = kStep_s; t < duration_s; t += kStep_s) {
    const Vec2 velocity_m_s = speed_m_s * direction_of(course_rad(t));
    position_m += kStep_s * velocity_m_s;
    TargetState target = walker(position_m, velocity_m_s, t);
    target.body_yaw_rad = wrap_angle(chest_rad(t));
    target.body_yaw_rad = unflipped_yaw_rad(offset, target);
    remember(history, {t, {position_m, velocity_m_s}, target.body_yaw_rad});
    follow(offset, history, target);
  }
  return offset.angle_rad();
}

double straight_on(double) {
  return 0.4;
}
// To the left and right in turns, by 90° every two seconds.
double turns(double t) {
  const double phase = std::fmod(t, 4.0);
  const double there = std::clamp((phase - 1.0) / 0.4, 0.0, 1.0);
  const double back = std::clamp((phase - 3.0) / 0.4, 0.0, 1.0);
  return kPi / 2.0 * (there - back);
}

TEST(ChestOffset, IsNoneOfSomebodyWhoseChestPointsAhead) {
  EXPECT_NEAR(offset_of(straight_on, straight_on, 5.0), 0.0, 1e-6);
}

TEST(ChestOffset, IsFoundWithinTwoSecondsOfWalking) {
  for (const double aside_rad : {rad(23.0), rad(69.0), rad(-69.0), rad(175.0)}) {
    const auto chest = [&](double t) { return straight_on(t) + aside_rad; };
    EXPECT_NEAR(offset_of(straight_on, chest, 2.0), aside_rad, rad(12.0));
    EXPECT_NEAR(offset_of(straight_on, chest, 8.0), aside_rad, rad(5.0));
  }
}

TEST(ChestOffset, IsNotTakenFromAChestThatLeadsOrFollowsInTurns) {
  for (const double lead_s : {-0.2, 0.0, 0.3, 0.4}) {
    const auto chest = [&](double t) { return turns(t + lead_s); };
    for (double end_s = 8.0; end_s < 12.0; end_s += 0.5)
      EXPECT_LT(std::abs(offset_of(turns, chest, end_s)), rad(4.0)) << lead_s << " " << end_s;
  }
}

TEST(ChestOffset, IsNotLearntOfSomebodyWhoStands) {
  EXPECT_EQ(offset_of(
                straight_on, [](double) { return 2.0; }, 5.0, 0.1),
            0.0);
}

TEST(ChestOffset, AJumpToTheOtherSideIsTheDetectors) {
  const auto flips = [](double t) {
    return straight_on(t) + (std::fmod(t, 1.5) > 1.0 ? kPi : 0.0);
  };
  EXPECT_NEAR(offset_of(straight_on, flips, 6.2), 0.0, 1e-6);
  ChestOffset offset;
  TargetState target = walker({0, 0}, {1.5, 0.0}, 1.0);
  EXPECT_EQ(unflipped_yaw_rad(offset, target), 0.0);
  target = walker({0, 0}, {1.5, 0.0}, 1.03);
  target.body_yaw_rad = 3.0;
  EXPECT_NEAR(unflipped_yaw_rad(offset, target), 3.0 - kPi, 1e-9);
}

TEST(ChestOffset, WhoWasOutOfSightMayHaveTurnedRound) {
  ChestOffset offset;
  TargetState target = walker({0, 0}, {1.5, 0.0}, 1.0);
  unflipped_yaw_rad(offset, target);
  target = walker({0, 0}, {-1.5, 0.0}, 2.0);
  EXPECT_EQ(unflipped_yaw_rad(offset, target), target.body_yaw_rad);
}

TEST(ChestOffset, WhatIsNotSeenStaysUnknown) {
  ChestOffset offset;
  TargetState target = walker({0, 0}, {1.5, 0.0}, 1.0);
  target.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(unflipped_yaw_rad(offset, target)));
}

}  // namespace
}  // namespace foretrack
