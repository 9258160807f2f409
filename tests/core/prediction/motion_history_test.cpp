// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_history.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

MotionHistory::Sample sample_of_walk(double stamp_s) {
  return {stamp_s, {Vec2(1.5 * stamp_s, 0.0), Vec2(1.5, 0.0)}, 0.0, 0.0};
}

MotionHistory walked(double from_s, double to_s, double step_s) {
  MotionHistory history;
  for (double t = from_s; t < to_s + 1e-9; t += step_s) remember(history, sample_of_walk(t));
  return history;
}

TEST(MotionHistory, KeepsAtMostFiftyStatesASecondHoweverOftenTheyCome) {
  const MotionHistory history = walked(0.0, 1.0, 0.005);
  EXPECT_LE(history.count, 51);
  EXPECT_GE(history.count, 48);
  for (int i = 1; i < history.count; ++i)
    EXPECT_GE(history.back(i - 1).stamp_s - history.back(i).stamp_s, 0.018 - 1e-9);
}

TEST(MotionHistory, FindsTheYoungestThatIsOldEnough) {
  const MotionHistory history = walked(0.0, 1.0, 0.04);
  EXPECT_NEAR(history.before(1.0, 0.3).stamp_s, 0.68, 1e-9);
  EXPECT_NEAR(history.before(1.0, 0.0).stamp_s, 1.0, 1e-9);
  EXPECT_NEAR(history.before(1.0, 9.0).stamp_s, 0.0, 1e-9) << "there is no older one";
}

TEST(MotionHistory, ForgetsTheOldestWhenItIsFull) {
  const MotionHistory history = walked(0.0, 10.0, 0.04);
  EXPECT_EQ(history.count, MotionHistory::kCapacity);
  EXPECT_NEAR(history.back(0).stamp_s, 10.0, 1e-9);
  EXPECT_NEAR(history.before(10.0, 9.0).stamp_s, 10.0 - 0.04 * (MotionHistory::kCapacity - 1),
              1e-9);
}

TEST(MotionHistory, BeginsAnewAfterAGapAJumpOrAStampThatGoesBack) {
  const MotionHistory before = walked(0.0, 1.0, 0.04);
  MotionHistory history = before;
  remember(history, sample_of_walk(1.9));
  EXPECT_EQ(history.count, before.count + 1) << "where they led in 0.9 s";
  history = before;
  MotionHistory::Sample corrected = sample_of_walk(1.04);
  corrected.measured.position_m.y() = 0.2;
  remember(history, corrected);
  EXPECT_EQ(history.count, before.count + 1) << "a filter may correct itself";
  history = before;
  remember(history, sample_of_walk(2.1));
  EXPECT_EQ(history.count, 1) << "a gap";
  history = before;
  MotionHistory::Sample elsewhere = sample_of_walk(1.04);
  elsewhere.measured.position_m.y() = 1.1;
  remember(history, elsewhere);
  EXPECT_EQ(history.count, 1) << "somebody else";
  history = before;
  remember(history, sample_of_walk(0.5));
  EXPECT_EQ(history.count, 1) << "back in time";
  EXPECT_NEAR(history.back(0).stamp_s, 0.5, 1e-9);
}

}  // namespace
}  // namespace foretrack
