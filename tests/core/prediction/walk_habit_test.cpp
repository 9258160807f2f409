#include "core/prediction/turn_habit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.04;

// Walks on for so long, with a turn of a second at every `every_s`.
void walk(TurnHabit& habit, double& now_s, double for_s, double every_s) {
  for (const double until_s = now_s + for_s; now_s < until_s; now_s += kStep_s) {
    const bool turning = std::fmod(now_s, every_s) > every_s - 1.0;
    follow(habit, now_s, turning ? rad(60.0) : 0.0, true);
  }
}

TEST(TurnHabit, NearsTheRateAtWhichTheTargetTurns) {
  TurnHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 180.0, 4.0);
  EXPECT_NEAR(std::exp(habit.log_rate()), 0.25, 0.03);
}

TEST(TurnHabit, FallsWhileTheTargetWalksStraightOn) {
  TurnHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 60.0, 4.0);
  const double often = habit.log_rate();
  walk(habit, now_s, 60.0, 1e9);
  EXPECT_LT(habit.log_rate(), often - 0.6);
  EXPECT_NEAR(habit.straight_s, 60.0, 1.5);
}

TEST(TurnHabit, CountsATurnOnceThoughItsAngleWavers) {
  TurnHabit habit;
  for (int i = 0; i < 25; ++i) follow(habit, i * kStep_s, rad(i % 2 ? 35.0 : 25.0), true);
  EXPECT_NEAR(habit.turns, 1.0, 0.05);
  EXPECT_EQ(habit.straight_s, 0.0);
}

TEST(TurnHabit, TakesNeitherStandingNorAGapForWalking) {
  TurnHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 10.0, 1e9);
  const double walked_s = habit.walked_s;
  follow(habit, now_s + 30.0, 0.0, true);
  follow(habit, now_s + 30.5, 0.0, false);
  EXPECT_EQ(habit.walked_s, walked_s);
}

TEST(TurnHabit, StartsAnewWhereTimeGoesBack) {
  TurnHabit habit;
  double now_s = 0.0;
  walk(habit, now_s, 30.0, 4.0);
  follow(habit, 1.0, 0.0, true);
  EXPECT_EQ(habit.turns, 0.0);
  EXPECT_EQ(habit.walked_s, 0.0);
}

}  // namespace
}  // namespace foretrack
