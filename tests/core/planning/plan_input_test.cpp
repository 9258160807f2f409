// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan_input.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

class PlanInputs : public ::testing::Test {
 protected:
  PlanInputs() {
    input_.now_s = 10.0;
    input_.target.status = TrackStatus::kTracking;
    input_.intention = &intention_;
    input_.prediction = &prediction_;
    input_.map = &map_;
    input_.bodies = &bodies_;
  }
  void stamp_all(double stamp_s) {
    input_.target.stamp_s = intention_.stamp_s = prediction_.stamp_s = bodies_.stamp_s = stamp_s;
  }
  PlanInput input_;
  IntentionAssessment intention_;
  Prediction prediction_;
  MovingBodies bodies_;
  GridMap map_ = known_map(testing::empty_world(2.0), 0.2);
  HorizonParams params_;
};

TEST_F(PlanInputs, FreshOnesStay) {
  stamp_all(10.0 - 0.9 * params_.target_stale_s);
  const PlanInput fresh = without_stale(input_, params_);
  EXPECT_TRUE(fresh.target.usable());
  EXPECT_EQ(fresh.prediction, &prediction_);
  EXPECT_EQ(fresh.intention, &intention_);
  EXPECT_EQ(fresh.bodies, &bodies_);
}

TEST_F(PlanInputs, StaleOnesAreDroppedAndAStaleTargetIsLost) {
  stamp_all(10.0 - 1.1 * params_.target_stale_s);
  const PlanInput fresh = without_stale(input_, params_);
  EXPECT_EQ(fresh.target.status, TrackStatus::kLost);
  EXPECT_EQ(fresh.prediction, nullptr);
  EXPECT_EQ(fresh.intention, nullptr);
  EXPECT_EQ(fresh.bodies, nullptr);
}

TEST_F(PlanInputs, AKnownMapNeverGrowsOldAMeasuredOneDoes) {
  EXPECT_EQ(without_stale(input_, params_).map, &map_);
  map_.stamp_s = 10.0 - 0.9 * params_.map_stale_s;
  EXPECT_EQ(without_stale(input_, params_).map, &map_);
  map_.stamp_s = 10.0 - 1.1 * params_.map_stale_s;
  EXPECT_EQ(without_stale(input_, params_).map, nullptr);
  map_ = {};
  EXPECT_EQ(without_stale(input_, params_).map, nullptr);
}

}  // namespace
}  // namespace foretrack
