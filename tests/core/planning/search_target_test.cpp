// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search_target.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

// Somebody was lost ahead; the camera looks back.
struct Lost : OnePlan {
  Lost() {
    update_belief(state.belief, input.target, nullptr, params.horizon);
    input.now_s += 1.5;
    input.vehicle = testing::hovering({-2.0, 0.0, 1.3}, kPi, input.now_s);
    state.lost_since_s = input.now_s;
  }
  PlanStart start() const {
    return choose_start(state.results[state.flown].trajectory, input, params);
  }
  PlanTask lost_task() { return {input, params, params.limits, start(), true}; }
};

TEST(SearchTarget, BeginsOnceAndLooksToWhereTheBeliefIs) {
  Lost one;
  for (int i = 0; i < 12; ++i, one.input.now_s += 0.05)
    search_on(one.state, one.input, one.start(), true, one.params);
  EXPECT_TRUE(one.state.search.active);
  EXPECT_FALSE(one.state.search.waits);
  EXPECT_EQ(one.state.search.since_s, 5.0);
  EXPECT_LT(std::abs(one.state.search.gaze_rad), 0.8) << "ahead";
  one.state.courses.count = 0;
  ASSERT_EQ(search_target(one.state, one.lost_task(), one.clock), PlanReason::kOk);
  const PlannedTrajectory& flown = one.state.next_result().trajectory;
  const auto off_rad = [&](const AngleNode& node) {
    return std::abs(wrap_angle(node.angle_rad - one.state.search.gaze_rad));
  };
  // The stop is over before the camera has turned round: it is on its way.
  const double turned_rad = off_rad(flown.yaw.nodes.front()) - off_rad(flown.yaw.nodes.back());
  EXPECT_GT(turned_rad, 0.5);
}

TEST(SearchTarget, FliesAlongTheChosenWay) {
  Lost one;
  search_on(one.state, one.input, one.start(), true, one.params);
  one.state.search.way = {{-2.0, 0.0}, {-2.0, 1.0}, {-2.0, 2.0}, {-2.0, 3.0}};
  one.state.courses.count = 0;
  ASSERT_EQ(search_target(one.state, one.lost_task(), one.clock), PlanReason::kOk);
  const PlannedTrajectory& t = one.state.next_result().trajectory;
  EXPECT_LT((t.position(t.duration_s()).head<2>() - Vec2(-2.0, 3.0)).norm(), 0.6);
}

TEST(SearchTarget, WhoWaitsStandsAndLooksAtTheLikeliestPlace) {
  Lost one;
  search_on(one.state, one.input, one.start(), false, one.params);
  EXPECT_TRUE(one.state.search.waits);
  one.state.search.likeliest_m = {-2.0, 4.0};
  one.state.courses.count = 0;
  ASSERT_EQ(wait_for_target(one.state, one.lost_task(), one.clock), PlanReason::kOk);
  const PlannedTrajectory& t = one.state.next_result().trajectory;
  EXPECT_LT((t.position(t.duration_s()) - one.input.vehicle.position_enu_m).norm(), 0.05);
  EXPECT_GT(std::abs(wrap_angle(t.yaw.nodes.back().angle_rad - kPi)), 0.2) << "it turns there";
}

}  // namespace
}  // namespace foretrack
