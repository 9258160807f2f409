// SPDX-License-Identifier: Apache-2.0
// The mode that a pilot selects, within the whole gate.
#include "core/safety/follow_mode.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

// The flight controller has the mode, and asks whether it may run.
struct WithMode : FlightLoop {
  WithMode() { run_with_plans(1.0); }

  ModeHindrance hindrance() const { return result.mode_hindrance; }
  void select() {
    autopilot.enter(FlightMode::kOffboard);
    autopilot.status.own_mode = autopilot.status.own_selected = true;
  }
  void leave(FlightMode mode, bool still_selected = false) {
    autopilot.enter(mode);
    autopilot.status.own_mode = false;
    autopilot.status.own_selected = still_selected;
  }
};

TEST(FollowMode, SelectingItIsAStartThatAsksForNothing) {
  WithMode loop;
  ASSERT_EQ(loop.hindrance(), ModeHindrance::kNone);
  loop.select();
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  EXPECT_EQ(loop.result.mode, SafetyMode::kTrack);
  EXPECT_TRUE(loop.result.setpoint);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kNone);
}

TEST(FollowMode, OffboardModeOfSomebodyElseIsNoStart) {
  WithMode loop;
  loop.autopilot.enter(FlightMode::kOffboard);
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_FALSE(loop.result.setpoint);
}

TEST(FollowMode, WithoutAPlanItMayNotRunAndSaysWhy) {
  FlightLoop loop;
  loop.run(1.0);
  EXPECT_EQ(loop.result.mode_hindrance, ModeHindrance::kNotReady);
  EXPECT_EQ(loop.result.mode_reason, SafetyReason::kNoPlanYet);
  WithMode stale;
  stale.run(kReadyFor_s + 0.5);
  EXPECT_EQ(stale.hindrance(), ModeHindrance::kNotReady) << "the plans have ceased";
}

TEST(FollowMode, APlanThatIsLateForAMomentDoesNotTurnTheModeDown) {
  WithMode loop;
  loop.run(0.6);  // no plan for longer than one is fresh
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kNone);
  loop.select();
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

TEST(FollowMode, AfterAStopItMayNotRunUntilAnOrderToStart) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.order(MissionOrder::kStop);
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kNone) << "it brakes and holds in the mode";
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  loop.leave(FlightMode::kPilot);
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kStopped);
  loop.select();
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_FALSE(loop.result.setpoint);
}

TEST(FollowMode, WhileSomebodyHoldsTheLeaseItMayNotRun) {
  WithMode loop;
  loop.order(MissionOrder::kLease);
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kLease);
  loop.select();
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  loop.run_with_plans(loop.params.lease_s);  // it is not renewed
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

TEST(FollowMode, WhoeverLeavesItEndsTheMissionAndSelectsItAgainToStart) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.leave(FlightMode::kPilot);
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kPilot);
  EXPECT_FALSE(loop.result.setpoint);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kNone);
  loop.select();
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

TEST(FollowMode, AFailsafeEndsTheMissionAndItsEndDoesNotResumeIt) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.leave(FlightMode::kReturn, true);
  loop.autopilot.status.failsafe = true;
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.end, MissionEnd::kFailsafe);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kOver);
  loop.autopilot.status.failsafe = false;
  loop.select();  // the flight controller comes back to what was chosen
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_FALSE(loop.result.setpoint);
  loop.leave(FlightMode::kHold);
  loop.run_with_plans(0.1);
  loop.select();
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

TEST(FollowMode, WhereNothingCanBeCommandedItIsTurnedDownInFlight) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.run(loop.params.hover_limit_s + 1.0);  // the planner is dead
  EXPECT_EQ(loop.result.mode, SafetyMode::kSilent);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kSilent);
}

TEST(FollowMode, MovedSticksEndTheMissionAndThePilotsModeIsAskedForOnce) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.autopilot.status.sticks_moved = true;
  loop.run_with_plans(kTick_s);
  EXPECT_EQ(loop.autopilot.count(AutopilotRequest::kPilot), 1);
  EXPECT_EQ(loop.result.end, MissionEnd::kSticks);
  loop.leave(FlightMode::kPilot);
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.autopilot.total(), 1);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
}

TEST(FollowMode, AnOrderToLandIsAskedForAndNoneIsFlownWhileItIsCarriedOut) {
  WithMode loop;
  loop.select();
  loop.run_with_plans(0.5);
  loop.order(MissionOrder::kLand);
  EXPECT_EQ(loop.autopilot.count(AutopilotRequest::kLand), 1);
  loop.leave(FlightMode::kLand);
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.hindrance(), ModeHindrance::kBusy);
}

}  // namespace
}  // namespace foretrack::testing
