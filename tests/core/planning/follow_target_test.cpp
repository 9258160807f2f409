// SPDX-License-Identifier: Apache-2.0
#include "core/planning/follow_target.hpp"

#include <gtest/gtest.h>

#include "core/planning/motion/stop_tail.hpp"
#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

TEST(FollowTarget, InTheOpenItGoesAlongWithTheTargetAndEndsAtRest) {
  OnePlan one;
  ASSERT_EQ(follow_target(one.state, one.task(), {}, one.clock), PlanReason::kOk);
  const PlannedTrajectory& candidate = one.state.next_result().trajectory;
  EXPECT_LT((candidate.position(0.0) - one.input.vehicle.position_enu_m).norm(), 1e-6);
  const double horizon_s = one.params.horizon.horizon_s;
  const Vec3 there = one.state.expected.paths[0].position(horizon_s);
  const double distance_m = distance_xy(candidate.position(horizon_s), there);
  EXPECT_GT(distance_m, one.params.place.distance_low_m);
  EXPECT_LT(distance_m, one.params.place.distance_high_m);
  EXPECT_LT(testing::end_speed_m_s(candidate), 1e-6);
  EXPECT_EQ(one.state.next_result().diagnostics.attempts, 1);
}

TEST(FollowTarget, AStopThatIsFlownBeforeIsItsFirstPiece) {
  OnePlan one;
  one.input.vehicle.velocity_enu_m_s = {0.0, 1.5, 0.0};
  const PlanTask task = one.task();
  const QuinticPiece stop = make_stop_tail(task.start.state, task.limits).piece;
  ASSERT_EQ(follow_target(one.state, task, stop, one.clock), PlanReason::kOk);
  const PlannedTrajectory& candidate = one.state.next_result().trajectory;
  EXPECT_LT(candidate.velocity(stop.duration_s).norm(), 1e-6);
  EXPECT_LT(
      (candidate.position(0.5 * stop.duration_s) - stop.position(0.5 * stop.duration_s)).norm(),
      1e-9);
  EXPECT_GT(candidate.duration_s(), stop.duration_s + 1.0);
}

TEST(FollowTarget, AVehicleWithinAnObstacleHasNoWay) {
  OnePlan one;
  one.world.boxes.push_back({{-3.0, -1.0, 0.0}, {-1.0, 1.0, 4.0}});
  one.build_map();
  EXPECT_NE(follow_target(one.state, one.task(), {}, one.clock), PlanReason::kOk);
}

TEST(FollowTarget, WhatHidesTheTargetAtThisLevelOnlyIsLookedOverInTheReplansThatFollow) {
  OnePlan one;
  // A bar across the whole world, at the wanted height: halfway, where neither of both is.
  one.world.boxes.push_back({{1.4, -10.0, 1.1}, {1.7, 10.0, 1.4}});
  one.input.target.position_enu_m.x() = 5.0;
  one.build_map();
  int seen = 0;
  for (int i = 0; i < 6; ++i) {
    follow_target(one.state, one.task(), {}, one.clock);
    seen += one.state.ahead.target_seen;
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace foretrack
