// SPDX-License-Identifier: Apache-2.0
#include "core/planning/frame_target.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr double kPlan_s = 0.03;

/// A person who walks to the east, and a vehicle 2 m behind that does as it is told.
struct Framed {
  PlanningParams params;
  FramingState state;
  PlanInput input;
  PlanningParams framed;
  double fastest_m_s = 0.0;  // at which distance or height changed

  Framed() {
    input.target.status = TrackStatus::kTracking;
    input.target.velocity_enu_m_s = {1.0, 0.0, 0.0};
    input.vehicle.position_enu_m = {-2.0, 0.0, 0.0};
  }
  const Framed& run(double for_s) {
    for (double t_s = 0.0; t_s < for_s; t_s += kPlan_s) {
      const FramingState before = state;
      framed = frame_target(state, input, params);
      if (before.active)
        fastest_m_s =
            std::max({fastest_m_s, std::abs(state.distance_m - before.distance_m) / kPlan_s,
                      std::abs(state.height_m - before.height_m) / kPlan_s});
      if (state.turns)
        input.vehicle.position_enu_m.head<2>() =
            state.distance_m * direction_of(state.bearing.at(input.now_s));
      input.now_s += kPlan_s;
    }
    return *this;
  }
  double bearing_rad() const { return yaw_of(input.vehicle.position_enu_m.head<2>()); }
};

TEST(FrameTarget, WithoutAFramingTheParametersAreThoseThatWereGiven) {
  Framed f;
  EXPECT_EQ(&frame_target(f.state, f.input, f.params), &f.params);
}

TEST(FrameTarget, TheBandMovesToTheDistanceSlowly) {
  Framed f;
  f.input.framing.distance_m = 4.0;
  f.run(1.0);
  EXPECT_NEAR(f.state.distance_m, f.params.distance_wanted_m() + 0.4, 0.02);
  f.run(9.0);
  EXPECT_NEAR(f.framed.distance_wanted_m(), 4.0, 1e-9);
  EXPECT_NEAR(f.framed.place.distance_high_m - f.framed.place.distance_low_m,
              f.params.place.distance_high_m - f.params.place.distance_low_m, 1e-9);
  EXPECT_LE(f.fastest_m_s, f.params.framing.framing_change_m_s + 1e-6);
}

TEST(FrameTarget, TheDistanceIsNeverLessThanIsSafe) {
  Framed f;
  f.input.framing.distance_m = 0.2;
  f.run(10.0);
  EXPECT_EQ(f.framed.place.distance_low_m, f.params.place.distance_low_m);
  EXPECT_GE(f.framed.distance_wanted_m(), f.params.place.kept_low_m());
  EXPECT_GE(f.framed.place.kept_high_m(), f.framed.place.kept_low_m());
}

TEST(FrameTarget, ThePersonIsNotLookedAtTooSteeply) {
  Framed f;
  f.input.framing.height_m = 5.0;
  f.run(20.0);
  EXPECT_NEAR(f.framed.place.height_above_target_m,
              f.params.distance_wanted_m() * std::tan(f.params.framing.framing_elevation_max_rad),
              1e-9);
  f.input.framing.distance_m = 10.0;
  f.run(30.0);
  EXPECT_NEAR(f.framed.place.height_above_target_m, 5.0, 1e-9);
}

TEST(FrameTarget, TheBearingGoesRoundFromWhereTheVehicleIs) {
  Framed f;
  f.input.framing.bearing_rad = -0.5 * kPi;  // at their right
  f.run(0.5);
  const double rate_rad_s = f.params.framing.framing_around_m_s / f.state.distance_m;
  EXPECT_NEAR(wrap_angle(f.bearing_rad() - kPi), 0.5 * rate_rad_s, 0.03);
  f.run(10.0);
  EXPECT_NEAR(f.bearing_rad(), -0.5 * kPi, 1e-6);
  f.input.target.velocity_enu_m_s = {0.0, 1.0, 0.0};  // they turn left
  f.run(10.0);
  EXPECT_NEAR(f.bearing_rad(), 0.0, 1e-6);
  f.input.target.velocity_enu_m_s.setZero();  // they stand: it stays
  f.input.target.body_yaw_rad = 2.0;
  f.run(5.0);
  EXPECT_NEAR(f.bearing_rad(), 0.0, 1e-6);
}

TEST(FrameTarget, OfSomebodyWhoNeverWalkedTheChestSaysWhereAheadIs) {
  Framed f;
  f.input.target.velocity_enu_m_s.setZero();
  f.input.framing.bearing_rad = 0.0;
  f.run(1.0);
  EXPECT_FALSE(f.state.turns);
  f.input.target.body_yaw_rad = 1.0;
  f.run(12.0);
  EXPECT_NEAR(f.bearing_rad(), 1.0, 1e-6);
}

TEST(FrameTarget, CirclesAtTheSpeedThatIsOrdered) {
  Framed f;
  f.input.framing.circling_rad_s = 0.2;
  f.run(1.0);
  const double before_rad = f.bearing_rad();
  f.run(3.0);
  EXPECT_NEAR(wrap_angle(f.bearing_rad() - before_rad), 0.6, 0.02);
  f.input.framing.circling_rad_s = -10.0;  // faster than it may go round
  const double from_rad = f.bearing_rad();
  f.run(1.0);
  EXPECT_NEAR(wrap_angle(f.bearing_rad() - from_rad),
              -f.params.framing.framing_around_m_s / f.state.distance_m, 0.03);
}

TEST(FrameTarget, ABearingWaitsForAVehicleThatCannotFollow) {
  Framed f;
  f.input.framing.bearing_rad = 0.0;
  for (int i = 0; i < 400; ++i) {
    frame_target(f.state, f.input, f.params);
    f.input.now_s += kPlan_s;  // the vehicle stays behind them
  }
  EXPECT_LT(std::abs(wrap_angle(f.state.bearing.now_rad - kPi)), 1.01);
}

TEST(FrameTarget, WhatIsGivenUpGoesBackToTheParametersAndIsForgotten) {
  Framed f;
  f.input.framing = {.distance_m = 3.0, .height_m = 1.0, .bearing_rad = 0.0};
  f.run(10.0);
  f.input.framing = {};
  f.run(0.5);
  EXPECT_FALSE(f.state.turns);
  EXPECT_TRUE(f.state.active);
  f.run(10.0);
  EXPECT_FALSE(f.state.active);
  EXPECT_EQ(&frame_target(f.state, f.input, f.params), &f.params);
  EXPECT_LE(f.fastest_m_s, f.params.framing.framing_change_m_s + 1e-6);
}

TEST(FrameTarget, ALostTargetHasNoBearing) {
  Framed f;
  f.input.framing.bearing_rad = 1.0;
  f.run(2.0);
  EXPECT_TRUE(f.state.turns);
  f.input.target.status = TrackStatus::kLost;
  f.run(0.1);
  EXPECT_FALSE(f.state.turns);
}

TEST(FrameTarget, APlannerThatStoodStillForLongMovesNothingOnAtOnce) {
  Framed f;
  f.input.framing.distance_m = 8.0;
  f.run(1.0);
  const double before_m = f.state.distance_m;
  f.input.now_s += 60.0;
  frame_target(f.state, f.input, f.params);
  EXPECT_EQ(f.state.distance_m, before_m);
}

}  // namespace
}  // namespace foretrack
