// SPDX-License-Identifier: Apache-2.0
#include "core/planning/publish_plan.hpp"

#include <gtest/gtest.h>

#include "core/planning/follow_target.hpp"
#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

TEST(PublishPlan, ACandidateBecomesWhatIsFlownWithANewId) {
  OnePlan one;
  one.state.last_id = 41;
  const PlanTask task = one.task();
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  const Vec3 end = one.state.next_result().trajectory.position(2.0);
  const PlanResult& result = publish(one.state, task, 0.0, one.clock);
  EXPECT_EQ(&result, &one.state.flown_result());
  EXPECT_EQ(result.trajectory.id, 42u);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kFresh);
  EXPECT_EQ(result.trajectory.reason, PlanReason::kOk);
  EXPECT_EQ(result.trajectory.stamp_s, one.input.target.stamp_s);
  EXPECT_EQ(result.trajectory.position(2.0), end);
}

TEST(PublishPlan, TellsTheCorridorAndEachRegionAtItsTime) {
  OnePlan one;
  const PlanTask task = one.task();
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  constexpr double kBegins_s = 0.5;
  const PlanResult& result = publish(one.state, task, kBegins_s, one.clock);
  EXPECT_EQ(result.trajectory.corridor.size(), one.state.problem.corridor.size());
  EXPECT_EQ(result.diagnostics.polytopes, static_cast<int>(result.trajectory.corridor.size()));
  EXPECT_EQ(result.diagnostics.samples, static_cast<int>(one.state.problem.samples.size()));
  const auto& regions = result.trajectory.visible_regions;
  ASSERT_EQ(regions.size(), one.state.ahead.views[0].size()) << "everything is seen in the open";
  for (std::size_t k = 0; k < regions.size(); ++k) {
    EXPECT_NEAR(regions[k].time_s,
                kBegins_s + one.params.horizon.step_s * static_cast<double>(k + 1), 1e-9);
    EXPECT_EQ(regions[k].half_angle_rad, one.state.ahead.views[0][k].shrunk.half_angle_rad);
    EXPECT_LT(
        (regions[k].target_enu_m - one.state.expected.paths[0].position(regions[k].time_s)).norm(),
        1e-9);
  }
}

TEST(PublishPlan, ASearchSaysSoWithTheStampOfWhatIsBelieved) {
  OnePlan one;
  const PlanTask task = one.task(true);
  ASSERT_EQ(follow_target(one.state, task, {}, one.clock), PlanReason::kOk);
  one.input.target.stamp_s = 99.0;
  const PlanResult& result = publish(one.state, task, 0.0, one.clock);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kSearch);
  EXPECT_EQ(result.trajectory.reason, PlanReason::kTargetLost);
  EXPECT_EQ(result.trajectory.stamp_s, 5.0);
}

}  // namespace
}  // namespace foretrack
