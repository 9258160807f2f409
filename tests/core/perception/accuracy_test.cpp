// SPDX-License-Identifier: Apache-2.0
// How well a walking person is estimated: 1.5 m/s, a sharp turn of 90°, seen from 2 m with 2 px
// and 3 cm of noise at 30 Hz.
#include <gtest/gtest.h>

#include "tests/core/perception/tracking_error.hpp"

namespace foretrack {
namespace {

using test::follow;
using test::TrackingError;

const TrackingError& usual() {
  static const TrackingError error = follow(12);
  return error;
}

TEST(TrackingAccuracy, PositionStaysWithinCentimetres) {
  const TrackingError& e = usual();
  EXPECT_LT(e.position_m, 0.04);
  EXPECT_LT(e.position_straight_m, 0.04);
}

TEST(TrackingAccuracy, VelocityIsSteadyOnTheStraightAndQuickInTheTurn) {
  const TrackingError& e = usual();
  EXPECT_LT(e.velocity_straight_m_s, 0.11);
  EXPECT_LT(e.velocity_m_s, 0.2);
  EXPECT_LE(e.velocity_lag_s, 0.11);
}

TEST(TrackingAccuracy, BodyYawShowsTheTurnWithinATenthOfASecond) {
  const TrackingError& e = usual();
  EXPECT_LE(e.yaw_lag_s, 0.1);
  EXPECT_LT(e.yaw_straight_rad, rad(4.0));
}

TEST(TrackingAccuracy, CovarianceIsHonestOnTheStraight) {
  // The mean of four squared normalised errors (position and velocity in the plane) is 4.
  const TrackingError& e = usual();
  EXPECT_GT(e.straight_nees, 1.0);
  EXPECT_LT(e.straight_nees, 6.0);
}

TEST(TrackingAccuracy, LandmarksTwiceAsNoisyDegradeGracefully) {
  test::FollowScene scene;
  scene.noise = {4.0, 0.06};
  const TrackingError e = follow(6, scene);
  EXPECT_LT(e.position_m, 0.12);
  EXPECT_LT(e.velocity_m_s, 0.3);
  EXPECT_LT(e.refused, 0.01);
}

TEST(TrackingAccuracy, EveryMeasurementOfAFastTurningTargetPassesTheGate) {
  test::FollowScene scene;
  scene.walk.speed_m_s = 2.0;
  EXPECT_EQ(follow(6, scene).refused, 0.0);
}

}  // namespace
}  // namespace foretrack
