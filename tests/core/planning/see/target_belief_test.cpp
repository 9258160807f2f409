// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/target_belief.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

Prediction two_paths() {
  Prediction prediction;
  prediction.stamp_s = 10.0;
  prediction.status = PredictionStatus::kOk;
  for (int i = 0; i < 2; ++i) {
    PredictedPath path;
    path.probability = i == 0 ? 0.95 : 0.05;
    const Vec3 velocity(i == 0 ? 1.0 : 0.0, i == 0 ? 0.0 : 1.0, 0.0);
    for (int k = 1; k <= 15; ++k) {
      PredictedState state;
      state.time_s = 0.2 * k;
      state.position_enu_m = Vec3(1.0, 2.0, 1.0) + state.time_s * velocity;
      state.velocity_enu_m_s = velocity;
      path.states.push_back(state);
    }
    prediction.paths.push_back(path);
  }
  return prediction;
}

class TargetBeliefTest : public ::testing::Test {
 protected:
  HorizonParams params_;
  TargetBelief belief_;
  ExpectedTarget expected_;
};

TEST_F(TargetBeliefTest, MovesPathsToTheClockOfTheTrajectory) {
  const Prediction prediction = two_paths();
  update_belief(belief_, {}, &prediction, params_);
  align(belief_, 10.13, params_, expected_);
  ASSERT_EQ(expected_.paths[0].positions_enu_m.size(), 15U);
  for (int k = 0; k < 15; ++k)
    EXPECT_NEAR(expected_.paths[0].positions_enu_m[k].x(), 1.0 + 0.13 + 0.2 * (k + 1), 1e-9);
}

TEST_F(TargetBeliefTest, APathGoesOnForAMomentAfterItsEndAndThenStands) {
  const Prediction prediction = two_paths();
  update_belief(belief_, {}, &prediction, params_);
  align(belief_, 15.0, params_, expected_);
  for (int k = 0; k < 15; ++k) {
    EXPECT_NEAR(expected_.paths[0].positions_enu_m[k].x(), 1.0 + 3.0 + 0.4, 1e-9);
    EXPECT_EQ(expected_.paths[0].velocities_enu_m_s[k].norm(), 0.0);
  }
}

TEST_F(TargetBeliefTest, BetweenItsSamplesAPathIsTheBelievedOne) {
  const Prediction prediction = two_paths();
  update_belief(belief_, {}, &prediction, params_);
  align(belief_, 10.13, params_, expected_);
  EXPECT_NEAR(expected_.paths[0].position(0.0).x(), 1.0 + 0.13, 1e-9);
  EXPECT_NEAR(expected_.paths[0].position(0.71).x(), 1.0 + 0.13 + 0.71, 1e-9);
  EXPECT_NEAR(expected_.paths[0].position(9.0).x(), 1.0 + 3.0 + 0.4, 1e-9);
}

TEST_F(TargetBeliefTest, LeavesOutUnlikelyPathsAndKeepsProbabilitiesNormalised) {
  Prediction prediction = two_paths();
  update_belief(belief_, {}, &prediction, params_);
  align(belief_, 10.0, params_, expected_);
  EXPECT_EQ(expected_.count, 1);
  EXPECT_NEAR(expected_.paths[0].probability, 1.0, 1e-12);
  prediction.paths[1].probability = 0.3;
  update_belief(belief_, {}, &prediction, params_);
  align(belief_, 10.0, params_, expected_);
  ASSERT_EQ(expected_.count, 2);
  EXPECT_NEAR(expected_.paths[1].probability, 0.3 / 1.25, 1e-12);
  params_.hedging = false;
  align(belief_, 10.0, params_, expected_);
  EXPECT_EQ(expected_.count, 1);
}

// A search that was cut short says less, not nothing.
TEST_F(TargetBeliefTest, UsesAnIncompletePredictionAsFarAsItGoes) {
  Prediction prediction = two_paths();
  prediction.status = PredictionStatus::kSearchExhausted;
  for (PredictedPath& path : prediction.paths) path.states.resize(5);
  TargetState target;
  target.stamp_s = 10.0;
  target.velocity_enu_m_s = {0.0, -9.0, 0.0};
  update_belief(belief_, target, &prediction, params_);
  align(belief_, 10.0, params_, expected_);
  EXPECT_NEAR(expected_.paths[0].positions_enu_m[4].x(), 2.0, 1e-9);
  EXPECT_NEAR(expected_.paths[0].positions_enu_m[14].x(), 2.4, 1e-9);
}

TEST_F(TargetBeliefTest, WithoutAPredictionTheTargetGoesStraightOn) {
  TargetState target;
  target.stamp_s = 5.0;
  target.position_enu_m = {1.0, 1.0, 1.0};
  target.velocity_enu_m_s = {0.0, -1.5, 0.3};
  update_belief(belief_, target, nullptr, params_);
  align(belief_, 5.1, params_, expected_);
  EXPECT_NEAR((expected_.paths[0].positions_enu_m[4] - Vec3(1.0, 1.0 - 1.5 * 1.1, 1.0)).norm(), 0.0,
              1e-9);
}

}  // namespace
}  // namespace foretrack
