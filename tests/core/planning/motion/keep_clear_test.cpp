// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/keep_clear.hpp"

#include <gtest/gtest.h>

#include "core/planning/motion/stop_tail.hpp"

namespace foretrack {
namespace {

// At constant velocity for two seconds, then a stop.
PlannedTrajectory straight(const Vec3& from, const Vec3& velocity) {
  PlannedTrajectory trajectory;
  trajectory.start_s = 10.0;
  QuinticPiece cruise;
  cruise.duration_s = 2.0;
  cruise.coefficients.row(0) = from;
  cruise.coefficients.row(1) = velocity;
  trajectory.pieces = {cruise};
  trajectory.pieces.push_back(
      make_stop_tail({cruise.position(2.0), velocity, Vec3::Zero()}, {}).piece);
  return trajectory;
}

class KeepClear : public ::testing::Test {
 protected:
  void add(const Vec3& foot, const Vec3& velocity, double horizon_s = 2.0) {
    MovingBody body;
    body.stamp_s = 10.0;
    body.position_enu_m = foot;
    body.velocity_enu_m_s = velocity;
    courses_.add({body, 1.0, horizon_s});
  }
  BodyGaps measure(const PlannedTrajectory& trajectory, double t_s = 0.0) const {
    return measure_gaps(trajectory, t_s, courses_, FlightLimits{}, params_);
  }
  BodyCourses courses_;
  GapParams params_;
};

TEST_F(KeepClear, WithoutBodiesEverythingIsClear) {
  const BodyGaps gaps = measure(straight({0, 0, 1.5}, {2, 0, 0}));
  EXPECT_TRUE(gaps.ok);
  EXPECT_EQ(gaps.cost, 0.0);
  EXPECT_TRUE(std::isinf(gaps.least_m));
}

TEST_F(KeepClear, MeasuresTheGapFromHullToHullWhereTheyWillBe) {
  add({4.0, 1.5, 0.0}, {-1.0, 0.0, 0.0});
  const BodyGaps gaps = measure(straight({0, 0, 1.2}, {1, 0, 0}));
  // They pass each other after 2 s, 1.5 m aside: less both radii.
  EXPECT_NEAR(gaps.least_m, 1.0, 0.01);
  EXPECT_NEAR(gaps.least_at_s, 2.0, 0.1);
  EXPECT_TRUE(gaps.ok);
}

TEST_F(KeepClear, WhoHoversIsNotClearOfSomebodyWhoWalksAtIt) {
  const PlannedTrajectory hover = straight({0, 0, 1.2}, Vec3::Zero());
  add({5.0, 0.0, 0.0}, {-1.0, 0.0, 0.0});
  EXPECT_TRUE(measure(hover).ok);
  courses_.count = 0;
  add({2.9, 0.0, 0.0}, {-1.0, 0.0, 0.0});
  EXPECT_FALSE(measure(hover).ok);
  EXPECT_GT(measure(hover).cost, measure(straight({0, 0, 1.2}, {-1, 0, 0})).cost);
}

TEST_F(KeepClear, HighAboveAHeadIsClear) {
  add({0.0, 0.0, 0.0}, Vec3::Zero());
  EXPECT_TRUE(measure(straight({0, 0, 1.75 + 0.25 + params_.gap_min_m + 0.01}, Vec3::Zero())).ok);
  EXPECT_FALSE(measure(straight({0, 0, 1.75 + 0.25 + params_.gap_min_m - 0.01}, Vec3::Zero())).ok);
}

TEST_F(KeepClear, AnUnlikelyCourseCountsOverAShorterTime) {
  add({3.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(measure(straight({0, 0, 1.2}, Vec3::Zero())).ok);
}

// The expected gap alone would be kept: somebody stands aside. They may step into the way.
TEST_F(KeepClear, PassesSlowlyBesideSomebodyWhoMayStepIntoTheWay) {
  add({1.8, 1.3, 0.0}, Vec3::Zero());
  const BodyGaps fast = measure(straight({0, 0, 1.2}, {2.5, 0, 0}));
  EXPECT_GT(fast.least_m, params_.gap_min_m);
  EXPECT_LT(fast.reach_m, params_.reach_gap_m);
  EXPECT_FALSE(fast.ok);
  EXPECT_TRUE(measure(straight({0, 0, 1.2}, {0.8, 0, 0})).ok);
}

// What stands can be left in any direction: nothing needs to be kept clear while it stops.
TEST_F(KeepClear, WhoHoversHasNoWayToStop) {
  add({1.3, 0.0, 0.0}, Vec3::Zero());
  EXPECT_TRUE(measure(straight({0, 0, 1.2}, Vec3::Zero())).ok);
}

TEST_F(KeepClear, TheRestOfATrajectoryIsMeasuredAtItsOwnTimes) {
  add({3.0, 0.0, 0.0}, Vec3::Zero());
  const PlannedTrajectory away = straight({2.1, 0, 1.2}, {-2, 0, 0});
  EXPECT_FALSE(measure(away).ok);
  EXPECT_TRUE(measure(away, 1.0).ok);
}

}  // namespace
}  // namespace foretrack
