// SPDX-License-Identifier: Apache-2.0
#include "core/planning/expect_target.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace foretrack {
namespace {

// A vehicle at the origin that looks along x, and a target 2 m ahead of it.
struct Watch {
  PlanningState state;
  PlanInput input;
  HorizonParams params;

  explicit Watch(const Vec3& velocity = {1.0, 0.0, 0.0}) {
    input.now_s = 5.0;
    input.vehicle.position_enu_m = {0.0, 0.0, 1.5};
    input.vehicle.q_world_body = Quat::Identity();
    input.target.position_enu_m = {2.0, 0.0, 1.0};
    input.target.velocity_enu_m_s = velocity;
  }
  PlanReason see(TrackStatus status, double now_s) {
    input.now_s = now_s;
    input.target.status = status;
    if (status == TrackStatus::kTracking) input.target.stamp_s = now_s;
    return expect_target(state, input, params);
  }
};

TEST(ExpectTarget, WhoWasNeverSeenIsNotSearchedFor) {
  Watch watch;
  EXPECT_EQ(watch.see(TrackStatus::kLost, 5.0), PlanReason::kNoTarget);
  EXPECT_FALSE(watch.state.lost());
}

TEST(ExpectTarget, WhoIsSeenIsBelievedAndALossIsForgotten) {
  Watch watch;
  EXPECT_EQ(watch.see(TrackStatus::kTracking, 5.0), PlanReason::kOk);
  EXPECT_EQ(watch.state.belief.count, 1);
  EXPECT_EQ(watch.see(TrackStatus::kLost, 5.1), PlanReason::kOk);
  EXPECT_TRUE(watch.state.lost());
  EXPECT_EQ(watch.see(TrackStatus::kTracking, 6.0), PlanReason::kOk);
  EXPECT_FALSE(watch.state.lost());
  EXPECT_EQ(watch.state.belief.stamp_s, 6.0);
}

TEST(ExpectTarget, WhileNobodyMeasuresTheBeliefStaysAsItWas) {
  Watch watch;
  watch.see(TrackStatus::kTracking, 5.0);
  watch.input.target.velocity_enu_m_s = {-1.0, 0.0, 0.0};
  EXPECT_EQ(watch.see(TrackStatus::kCoasting, 5.2), PlanReason::kOk);
  EXPECT_EQ(watch.state.belief.stamp_s, 5.0);
  EXPECT_GT(watch.state.belief.paths[0].states.back().position_enu_m.x(), 2.0);
}

TEST(ExpectTarget, ASearchEnds) {
  Watch watch;
  watch.see(TrackStatus::kTracking, 5.0);
  EXPECT_EQ(watch.see(TrackStatus::kLost, 5.1), PlanReason::kOk);
  EXPECT_EQ(watch.see(TrackStatus::kLost, 5.1 + watch.params.search_s - 0.1), PlanReason::kOk);
  EXPECT_EQ(watch.see(TrackStatus::kLost, 5.1 + watch.params.search_s + 0.1),
            PlanReason::kTargetLost);
}

TEST(ExpectTarget, ANumberThatIsNoneIsNobody) {
  Watch watch;
  watch.see(TrackStatus::kTracking, 5.0);
  watch.input.target.velocity_enu_m_s.x() = std::numeric_limits<double>::quiet_NaN();
  watch.see(TrackStatus::kTracking, 5.1);
  EXPECT_TRUE(watch.state.lost());
  EXPECT_EQ(watch.state.belief.stamp_s, 5.0);
}

}  // namespace
}  // namespace foretrack
