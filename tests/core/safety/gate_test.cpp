// SPDX-License-Identifier: Apache-2.0
#include "core/safety/gate.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

/// Flies, as ordered, from the origin.
struct Flying : FlightLoop {
  Flying() {
    take_off_and_track();
    EXPECT_EQ(state.mission.phase, MissionPhase::kTracking);
  }
  /// A plan along x that starts in the next tick, where the vehicle is.
  PlannedTrajectory plan(std::uint64_t id, double after_s = kTick_s, double from_x_m = 0.0) {
    return straight_plan(id, stamp_now_s() + after_s, from_x_m);
  }
};

TEST(Gate, TracksAFreshPlanWhereItIsAtThisMoment) {
  Flying loop;
  const auto plan = loop.plan(1001);
  const auto r = loop.tick(&plan);
  ASSERT_TRUE(r.setpoint);
  EXPECT_EQ(r.mode, SafetyMode::kTrack);
  const auto later = loop.run(0.2);
  ASSERT_TRUE(later.setpoint);
  EXPECT_NEAR(later.setpoint->position_enu_m.x(), 0.1, 1e-9);
  EXPECT_NEAR(later.setpoint->velocity_enu_m_s.x(), 0.5, 1e-9);
}

TEST(Gate, FliesTheOldPlanUntilTheNewOneStarts) {
  Flying loop;
  const auto first = loop.plan(1001), second = loop.plan(1002, 0.06, 0.025);
  loop.tick(&first);
  EXPECT_EQ(loop.tick(&second).plan_id, 1001U);
  loop.run(0.06);
  EXPECT_EQ(loop.tick().plan_id, 1002U);
}

// Before it flies, a plan that goes on from the last plan is not one from where the vehicle is.
TEST(Gate, WhileItFliesNoPlanEachMustBeginWhereTheVehicleIs) {
  FlightLoop loop;
  const auto here = straight_plan(1, loop.stamp_now_s() + kTick_s, 0.0);
  EXPECT_EQ(loop.tick(&here).refusal, PlanFault::kNone);
  loop.run(0.1);
  const auto ahead = straight_plan(2, loop.stamp_now_s() + kTick_s, 0.5);
  EXPECT_EQ(loop.tick(&ahead).refusal, PlanFault::kDoesNotJoin);
  const auto again = straight_plan(3, loop.stamp_now_s() + kTick_s, 0.0);
  EXPECT_EQ(loop.tick(&again).refusal, PlanFault::kNone);
}

TEST(Gate, StepsDownFromTrackToCoastToHoverToSilentWhenPlansCease) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  EXPECT_EQ(loop.run(0.2).mode, SafetyMode::kTrack);
  const auto coast = loop.run(0.2);
  EXPECT_EQ(coast.mode, SafetyMode::kCoast);
  EXPECT_EQ(coast.reason, SafetyReason::kPlanStale);
  EXPECT_TRUE(coast.heartbeat);
  const auto hover = loop.run(3.0);
  EXPECT_EQ(hover.mode, SafetyMode::kHover);
  ASSERT_TRUE(hover.setpoint);
  EXPECT_NEAR(hover.setpoint->position_enu_m.x(), 1.25, 1e-9);
  EXPECT_EQ(hover.setpoint->velocity_enu_m_s, Vec3::Zero());
  const auto silent = loop.run(3.0);
  EXPECT_EQ(silent.mode, SafetyMode::kSilent);
  EXPECT_FALSE(silent.heartbeat);
  EXPECT_FALSE(silent.setpoint);
}

TEST(Gate, TracksAgainWhenPlansComeBack) {
  Flying loop;
  const auto first = loop.plan(1001);
  loop.tick(&first);
  loop.run(4.0);
  loop.last_plan = 1002;
  const auto second = loop.plan(1002, 0.01, 1.25);
  loop.tick(&second);
  EXPECT_EQ(loop.tick().mode, SafetyMode::kTrack);
}

TEST(Gate, BrakesWhenTheVehicleIsFarOffItsTrajectory) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  loop.displaced = Vec3(0, 3, 1.5);
  const auto r = loop.tick();
  EXPECT_EQ(r.mode, SafetyMode::kBrake);
  ASSERT_TRUE(r.setpoint);
  EXPECT_TRUE(r.setpoint->position_enu_m.hasNaN());
  EXPECT_EQ(r.setpoint->velocity_enu_m_s, Vec3::Zero());
}

TEST(Gate, FallsSilentWithoutVehicleStateOrFlightController) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  loop.vehicle_alive = false;
  EXPECT_EQ(loop.run(0.4).reason, SafetyReason::kVehicleStale);
  loop.vehicle_alive = true;
  loop.autopilot_alive = false;
  const auto r = loop.run(2.1);
  EXPECT_EQ(r.mode, SafetyMode::kSilent);
  EXPECT_EQ(r.reason, SafetyReason::kAutopilotStale);
}

TEST(Gate, HoldsOnOrderAndStopsEvenWhenTheOrderIsOldOrRepeated) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  const MissionCommand hold{.id = 5, .stamp_s = loop.stamp_now_s(), .order = MissionOrder::kHold};
  EXPECT_EQ(loop.tick(nullptr, &hold).phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.tick(nullptr, &hold).command_result, MissionResult::kRefusedRepeated);
  const MissionCommand late{
      .id = 6, .stamp_s = loop.stamp_now_s() - 5.0, .order = MissionOrder::kResume};
  EXPECT_EQ(loop.tick(nullptr, &late).command_result, MissionResult::kRefusedLate);
  const MissionCommand stop{
      .id = 1, .stamp_s = loop.stamp_now_s() - 5.0, .order = MissionOrder::kStop};
  EXPECT_EQ(loop.tick(nullptr, &stop).phase, MissionPhase::kStopped);
}

TEST(Gate, StopsByBrakingAndThenHoldsWhereItCameToRest) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  loop.vehicle.velocity_enu_m_s = Vec3(1, 0, 0);
  EXPECT_EQ(loop.order(MissionOrder::kStop).mode, SafetyMode::kBrake);
  loop.vehicle.velocity_enu_m_s = Vec3::Zero();
  loop.displaced = Vec3(0.3, 0, 1.5);
  const auto stopped = loop.tick();
  EXPECT_EQ(stopped.mode, SafetyMode::kHover);
  ASSERT_TRUE(stopped.setpoint);
  EXPECT_EQ(stopped.setpoint->position_enu_m, Vec3(0.3, 0, 1.5));
}

TEST(Gate, StartsTheWaitingPlanBeforeANewerOneTakesItsPlace) {
  Flying loop;
  const auto first = loop.plan(1001), second = loop.plan(1002, 0.05, 0.02);
  loop.tick(&first);
  loop.tick(&second);
  loop.run(0.02);  // the second starts at the next tick, with which a third comes
  const auto third = loop.plan(1003, 0.4, 0.215);
  EXPECT_EQ(loop.tick(&third).plan_id, 1002U);
}

TEST(Gate, HoldsWhereItCameToRestAndNotWhereItHeldBeforeItWasPushedAway) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  ASSERT_EQ(loop.run(3.2).mode, SafetyMode::kHover);
  loop.last_plan = 1002;
  loop.displaced = Vec3(0, 4, 1.5);
  ASSERT_EQ(loop.tick().mode, SafetyMode::kBrake);
  loop.run_with_plans(loop.params.odometry_settle_s + 3.0);
  const auto r = loop.order(MissionOrder::kHold);
  ASSERT_EQ(r.mode, SafetyMode::kHover);
  ASSERT_TRUE(r.setpoint);
  EXPECT_EQ(r.setpoint->position_enu_m, Vec3(0, 4, 1.5));
}

TEST(Gate, AWaitingPlanThatComesAgainIsNeitherRefusedNorTakenTwice) {
  Flying loop;
  const auto first = loop.plan(1001), second = loop.plan(1002, 0.1, 0.045);
  loop.tick(&first);
  loop.tick(&second);
  EXPECT_EQ(loop.tick(&second).refusal, PlanFault::kNone);
  EXPECT_EQ(loop.run(0.15).plan_id, 1002U);
}

TEST(Gate, ANewerPlanThatStartsBeforeTheOneThatWaitsIsRefused) {
  Flying loop;
  const auto first = loop.plan(1001), late = loop.plan(1002, 0.4, 0.195);
  loop.tick(&first);
  loop.tick(&late);
  ASSERT_TRUE(loop.state.has_next);
  const auto sooner = loop.plan(1003, 0.1, 0.055);
  EXPECT_EQ(loop.tick(&sooner).refusal, PlanFault::kOutOfOrder);
  EXPECT_EQ(loop.run(0.2).plan_id, 1001U);
  EXPECT_EQ(loop.run(0.3).plan_id, 1002U);
}

TEST(Gate, HoldsTheEndOfAPlanForAsLongAsThePlannerRepeatsIt) {
  Flying loop;
  const auto plan = loop.plan(1001);
  for (int i = 0; i < 350; ++i) loop.tick(i % 5 == 0 ? &plan : nullptr);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_EQ(loop.result.reason, SafetyReason::kPlanHolds);
  ASSERT_TRUE(loop.result.setpoint);
  EXPECT_NEAR(loop.result.setpoint->position_enu_m.x(), 1.25, 1e-9);
}

TEST(Gate, WithoutAMapOrWithAnOldOneNoPlanIsTaken) {
  GridMap stamped = open_map();
  stamped.stamp_s = 1.0;
  for (const GridMap* map :
       {static_cast<const GridMap*>(nullptr), static_cast<const GridMap*>(&stamped)}) {
    Flying loop;
    loop.extra.map = map;
    loop.extra.map_at_s = loop.now_s - loop.params.map_stale_s - 0.1;
    const auto plan = loop.plan(1001);
    EXPECT_EQ(loop.tick(&plan).refusal, PlanFault::kNoMap);
    loop.extra.map_at_s = loop.now_s;
    const auto next = loop.plan(1002);
    EXPECT_EQ(loop.tick(&next).refusal, map ? PlanFault::kNone : PlanFault::kNoMap);
  }
}

TEST(Gate, WithoutOdometryForLongItIsSilent) {
  Flying loop;
  loop.vehicle_alive = false;
  const auto r = loop.run(loop.params.vehicle_lost_s + 0.2);
  EXPECT_EQ(r.mode, SafetyMode::kSilent);
  EXPECT_EQ(r.reason, SafetyReason::kVehicleStale);
  EXPECT_FALSE(r.heartbeat);
}

TEST(Gate, AVehicleThatIsNotArmedIsNotExpectedToMove) {
  FlightLoop loop;
  loop.autopilot.status.armed = false;
  loop.autopilot.enter(FlightMode::kOffboard);
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;  // it is not armed either
  loop.order(MissionOrder::kStart);
  const auto plan = straight_plan(1001, loop.stamp_now_s() + kTick_s);
  loop.displaced = Vec3(0, 0, 1.5);
  loop.tick(&plan);
  loop.tick();
  ASSERT_TRUE(loop.result.setpoint);
  EXPECT_GT(loop.result.setpoint->velocity_enu_m_s.norm(), 0.1);
  EXPECT_EQ(loop.state.commanded_enu_m_s, Vec3::Zero());
}

TEST(Gate, FliesOnByTheMonotonicClockWhenTheOtherIsSet) {
  for (const double step_s : {3600.0, -3600.0, 0.45}) {
    Flying loop;
    const auto plan = loop.plan(1001);
    loop.tick(&plan);
    loop.run(0.1);
    loop.clock_offset_s += step_s;
    const auto r = loop.run(0.1);
    EXPECT_EQ(r.mode, SafetyMode::kTrack) << step_s;
    ASSERT_TRUE(r.setpoint);
    EXPECT_NEAR(r.setpoint->position_enu_m.x(), 0.1, 1e-9) << step_s;
    EXPECT_EQ(loop.run(0.2).mode, SafetyMode::kCoast) << step_s;
  }
}

TEST(Gate, APlaceToReturnToIsAskedForOnceWhileItFliesOn) {
  Flying loop;
  const auto plan = loop.plan(1001);
  loop.tick(&plan);
  MissionCommand lease{.id = 100,
                       .stamp_s = loop.stamp_now_s(),
                       .order = MissionOrder::kLease,
                       .operator_name = "ada",
                       .lease_id = "ada",
                       .proved = true};
  ASSERT_TRUE(is_accepted(loop.tick(nullptr, &lease).command_result));
  MissionCommand place = lease;
  place.id = 101;
  place.order = MissionOrder::kSetReturnPlace;
  place.return_place_enu_m = {7.0, -2.0};
  int asked = 0;
  GateResult r = loop.tick(nullptr, &place);
  EXPECT_EQ(r.command_result, MissionResult::kAccepted);
  for (int i = 0; i < 5; ++i, r = loop.tick()) {
    if (r.request != AutopilotRequest::kHome) continue;
    ++asked;
    EXPECT_EQ(r.return_place_enu_m, (FlightBounds::Corner{7.0, -2.0}));
  }
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(r.phase, MissionPhase::kTracking);
  place.id = 102;
  place.proved = false;
  EXPECT_EQ(loop.tick(nullptr, &place).command_result, MissionResult::kRefusedUnproved);
  EXPECT_EQ(loop.tick().request, AutopilotRequest::kNone);
}

}  // namespace
}  // namespace foretrack::testing
