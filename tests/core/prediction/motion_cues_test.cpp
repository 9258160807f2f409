// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_cues.hpp"

#include <gtest/gtest.h>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

TEST(MotionCues, WrapsTheBodysTurnAcrossPi) {
  MotionMemory memory;
  TargetState target = walker({0, 0}, direction_of(rad(175.0)));
  target.body_yaw_rad = rad(-165.0);
  EXPECT_NEAR(observe_motion(memory, target, {}).body_turn_rad, rad(20.0), 1e-12);
}

TEST(MotionCues, HasNoBodyTurnBelowWalkingSpeedOrWithoutAYaw) {
  MotionMemory memory;
  TargetState slow = walker({0, 0}, {0.1, 0.0});
  slow.body_yaw_rad = 1.0;
  const MotionCues cues = observe_motion(memory, slow, {});
  EXPECT_EQ(cues.body_turn_rad, 0.0);
  EXPECT_EQ(cues.heading_rad, 1.0);  // where the chest points
  TargetState faceless = walker({0, 0}, {1.0, 0.0}, 1.1);
  faceless.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(observe_motion(memory, faceless, {}).body_turn_rad, 0.0);
}

TEST(MotionCues, ReadsTurnRateAndFallOfSpeedFromTheHistory) {
  MotionMemory memory;
  MotionCues cues;
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.04 * i;
    const double speed = 2.0 - 0.5 * t;
    cues = observe_motion(memory, walker({0, 0}, speed * direction_of(0.8 * t), t), {});
  }
  EXPECT_NEAR(cues.turn_rate_rad_s, 0.8, 1e-9);
  EXPECT_NEAR(cues.recent_turn_rad, 0.8, 1e-9);
  EXPECT_NEAR(cues.speed_fall_m_s, 0.5 * 0.4, 1e-9);
}

TEST(MotionCues, StartsAnewAfterAGapOrAStepBackInTime) {
  for (const double next_s : {9.0, 2.0}) {
    MotionMemory memory;
    observe_motion(memory, walker({0, 0}, {2.0, 0.0}, 5.0), {});
    const MotionCues cues = observe_motion(memory, walker({0, 0}, {0.0, 1.0}, next_s), {});
    EXPECT_EQ(cues.speed_fall_m_s, 0.0);
    EXPECT_EQ(cues.recent_turn_rad, 0.0);
    EXPECT_EQ(memory.history.count, 1);
  }
}

TEST(MotionCues, ReachesASecondBackAtAnyRate) {
  for (const double rate_hz : {10.0, 50.0, 200.0}) {
    MotionMemory memory;
    MotionCues cues;
    for (int i = 0; i <= 2 * rate_hz; ++i)
      cues =
          observe_motion(memory, walker({0, 0}, direction_of(0.5 * i / rate_hz), i / rate_hz), {});
    EXPECT_NEAR(cues.recent_turn_rad, 0.5, 0.02) << rate_hz;
  }
}

}  // namespace
}  // namespace foretrack
