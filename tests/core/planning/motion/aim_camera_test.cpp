// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/aim_camera.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

class AimCamera : public ::testing::Test {
 protected:
  AimCamera() {
    QuinticPiece hover;
    hover.duration_s = 3.0;
    hover.coefficients.row(0) = Vec3(0.0, 0.0, 1.5);
    trajectory_.pieces = {hover};
  }
  void expect(std::initializer_list<std::pair<double, Vec3>> places) {
    belief_ = {};
    for (const auto& [probability, place] : places) {
      PredictedPath& path = belief_.paths[belief_.count++];
      path.probability = probability;
      path.states.push_back({.time_s = 0.2, .position_enu_m = place});
    }
    align(belief_, 0.0, params_.horizon, expected_);
  }
  double end_rad() const { return trajectory_.yaw.at(3.0).angle_rad; }

  PlanStart start_;
  TargetBelief belief_;
  ExpectedTarget expected_;
  PlanningParams params_;
  AimWorkspace workspace_;
  PlannedTrajectory trajectory_;
};

TEST_F(AimCamera, TurnsToWhereTheTargetIsExpected) {
  expect({{1.0, {2.0, 2.0, 1.0}}});
  aim_camera(start_, expected_, params_, workspace_, trajectory_);
  EXPECT_NEAR(end_rad(), rad(45.0), 0.02);
  EXPECT_TRUE(trajectory_.gimbal_pitch.nodes.empty());
}

TEST_F(AimCamera, LooksBetweenPlacesByTheirProbability) {
  expect({{0.5, {2.0, 2.0, 1.0}}, {0.5, {2.0, -2.0, 1.0}}});
  aim_camera(start_, expected_, params_, workspace_, trajectory_);
  EXPECT_NEAR(end_rad(), 0.0, 0.02);
  expect({{0.9, {2.0, 2.0, 1.0}}, {0.1, {2.0, -2.0, 1.0}}});
  aim_camera(start_, expected_, params_, workspace_, trajectory_);
  EXPECT_GT(end_rad(), rad(30.0));
}

TEST_F(AimCamera, HoldsByBrakingTheTurn) {
  start_.yaw = {0.4, 1.0};
  hold_camera(start_, params_, workspace_, trajectory_);
  EXPECT_EQ(trajectory_.yaw.nodes.back().rate_rad_s, 0.0);
  EXPECT_NEAR(trajectory_.yaw.nodes.back().angle_rad, 0.4 + 0.5 / 6.0, 0.05);
}

}  // namespace
}  // namespace foretrack
