// SPDX-License-Identifier: Apache-2.0
#include "core/planning/attempts.hpp"

#include <gtest/gtest.h>

#include "core/planning/follow_target.hpp"
#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

TEST(Attempts, OneIsEnoughWhereThereIsRoom) {
  OnePlan one;
  const PlanTask task = one.task();
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  one.state.next_result().diagnostics = {};
  EXPECT_EQ(attempt_all(one.state, task, {}, one.clock), PlanReason::kOk);
  EXPECT_EQ(one.state.next_result().diagnostics.attempts, 1);
  EXPECT_GT(one.state.next_result().diagnostics.iterations, 0);
}

TEST(Attempts, ThreeAreMadeAndTheFirstsReasonIsTold) {
  OnePlan one;
  const PlanTask task = one.task();
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  const std::vector<double> before_s = one.state.problem.durations_s;
  one.world.boxes.push_back({{-1.0, -9.0, 0.0}, {-0.7, 9.0, 4.0}});  // across
  one.build_map();
  one.state.next_result().diagnostics = {};
  EXPECT_EQ(attempt_all(one.state, task, {}, one.clock), PlanReason::kClearanceViolated);
  EXPECT_EQ(one.state.next_result().diagnostics.attempts, 3);
  EXPECT_EQ(one.state.problem.goal.velocity, Vec3::Zero()) << "the later ones end at rest";
  for (std::size_t i = 0; i < before_s.size(); ++i)
    EXPECT_NEAR(one.state.problem.durations_s[i], 1.4 * before_s[i], 1e-9);
}

TEST(Attempts, TheCameraLooksWhereTheTargetIsExpected) {
  OnePlan one;
  const PlanTask task = one.task();
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  PlannedTrajectory trajectory = one.state.next_result().trajectory;
  const auto turned_rad = [&] { return std::abs(trajectory.yaw.at(2.0).angle_rad); };
  EXPECT_LT(turned_rad(), 0.3) << "the target is ahead";
}

}  // namespace
}  // namespace foretrack
