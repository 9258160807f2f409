// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/walk_habit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kHabitStep_s = 0.04;
constexpr double kPace_m_s = 1.4, kWalking_m_s = 0.2;

// Walks on for so long, with a turn of a second at every `every_s`.
void walk(WalkHabit& habit, double& now_s, double for_s, double every_s) {
  for (const double until_s = now_s + for_s; now_s < until_s; now_s += kHabitStep_s) {
    const bool turning = std::fmod(now_s, every_s) > every_s - 1.0;
    follow(habit, {now_s, turning ? rad(60.0) : 0.0, kPace_m_s}, kWalking_m_s);
  }
}

TEST(WalkHabit, NearsTheRateAtWhichTheTargetTurns) {
  WalkHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 180.0, 4.0);
  EXPECT_NEAR(std::exp(habit.log_turn_rate()), 0.25, 0.03);
}

TEST(WalkHabit, FallsWhileTheTargetWalksStraightOn) {
  WalkHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 60.0, 4.0);
  const double often = habit.log_turn_rate();
  walk(habit, now_s, 60.0, 1e9);
  EXPECT_LT(habit.log_turn_rate(), often - 0.6);
  EXPECT_NEAR(habit.straight_s, 60.0, 1.5);
}

TEST(WalkHabit, CountsATurnOnceThoughItsAngleWavers) {
  WalkHabit habit;
  for (int i = 0; i < 25; ++i)
    follow(habit, {i * kHabitStep_s, rad(i % 2 ? 35.0 : 25.0), kPace_m_s}, kWalking_m_s);
  EXPECT_NEAR(habit.turns, 1.0, 0.05);
  EXPECT_EQ(habit.straight_s, 0.0);
}

// Walks for so long, with a stand of a second at the end of every `every_s`.
void walk_and_stop(WalkHabit& habit, double& now_s, double for_s, double every_s) {
  for (const double until_s = now_s + for_s; now_s < until_s; now_s += kHabitStep_s) {
    const bool stands = std::fmod(now_s, every_s) > every_s - 1.0;
    follow(habit, {now_s, 0.0, stands ? 0.05 : kPace_m_s}, kWalking_m_s);
  }
}

TEST(WalkHabit, NearsTheRateAtWhichTheTargetStops) {
  WalkHabit habit;
  double now_s = 0.0;
  const double before = habit.log_stop_rate();
  walk_and_stop(habit, now_s, 120.0, 5.0);
  EXPECT_NEAR(std::exp(habit.log_stop_rate()), 0.25, 0.08);  // of walked time
  EXPECT_GT(habit.log_stop_rate(), before + 1.0);
}

TEST(WalkHabit, DoesNotTakeASlowStepOrTheFirstStandForAStop) {
  WalkHabit habit;
  for (int i = 0; i < 25; ++i) follow(habit, {i * kHabitStep_s, 0.0, 0.0}, kWalking_m_s);
  for (int i = 25; i < 200; ++i)
    follow(habit, {i * kHabitStep_s, 0.0, i % 2 ? 0.7 : 0.35}, kWalking_m_s);
  EXPECT_EQ(habit.stops, 0.0);
}

TEST(WalkHabit, TakesNeitherStandingNorAGapForWalking) {
  WalkHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 10.0, 1e9);
  const double walked_s = habit.walked_s;
  follow(habit, {now_s + 30.0, 0.0, kPace_m_s}, kWalking_m_s);
  follow(habit, {now_s + 30.5, 0.0, 0.0}, kWalking_m_s);
  EXPECT_EQ(habit.walked_s, walked_s);
}

TEST(WalkHabit, StartsAnewWhereTimeGoesBack) {
  WalkHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 30.0, 4.0);
  follow(habit, {1.0, 0.0, kPace_m_s}, kWalking_m_s);
  EXPECT_EQ(habit.turns, 0.0);
  EXPECT_EQ(habit.walked_s, 0.0);
}

}  // namespace
}  // namespace foretrack
