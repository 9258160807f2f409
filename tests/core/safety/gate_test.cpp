// SPDX-License-Identifier: Apache-2.0
#include "core/safety/gate.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// Straight along x at 1 m/s for 2 s, then to rest within 1 s.
PlannedTrajectory straight_plan(std::uint64_t id, double start_s, double from_x_m = 0.0) {
  PlannedTrajectory plan;
  plan.id = id;
  plan.start_s = start_s;
  plan.status = PlanStatus::kFresh;
  QuinticPiece cruise{.duration_s = 2.0};
  cruise.coefficients.row(0) = Vec3(from_x_m, 0, 1.5);
  cruise.coefficients.row(1) = Vec3(1, 0, 0);
  QuinticPiece tail{.duration_s =
                        1.0};  // p = x + t − t³ + t⁴/2: v(0) = 1, v(1) = 0, a(0) = a(1) = 0
  tail.coefficients.row(0) = Vec3(from_x_m + 2.0, 0, 1.5);
  tail.coefficients.row(1) = Vec3(1, 0, 0);
  tail.coefficients.row(3) = Vec3(-1, 0, 0);
  tail.coefficients.row(4) = Vec3(0.5, 0, 0);
  plan.pieces = {cruise, tail};
  plan.tail_start_s = 2.0;
  plan.yaw.nodes = {{0.0, 0.1}, {0.01, 0.1}};
  return plan;
}

struct Loop {
  SafetyParams params;
  GateState state;
  double now_s = 0.0;
  bool offboard = true;
  bool vehicle_alive = true, autopilot_alive = true;
  std::optional<Vec3> displaced;
  VehicleState vehicle{.position_enu_m = Vec3(0, 0, 1.5)};
  double last_vehicle_s = 0.0, last_autopilot_s = 0.0;

  GateResult tick(const PlannedTrajectory* plan = nullptr,
                  const MissionCommand* command = nullptr) {
    now_s += 0.01;
    if (vehicle_alive) last_vehicle_s = now_s;
    if (autopilot_alive) last_autopilot_s = now_s;
    if (state.has_flown) vehicle.position_enu_m = state.flown.position(now_s - state.flown.start_s);
    if (displaced) vehicle.position_enu_m = *displaced;
    vehicle.stamp_s = last_vehicle_s;
    const AutopilotStatus autopilot{
        .stamp_s = last_autopilot_s, .armed = true, .offboard = offboard};
    return gate(state, {now_s, plan, vehicle, autopilot, command}, params);
  }
  GateResult run(double for_s) {
    GateResult r;
    for (int i = 0; i < static_cast<int>(for_s / 0.01 + 0.5); ++i) r = tick();
    return r;
  }
};

TEST(Gate, TracksAFreshPlanWhereItIsAtThisMoment) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  const auto r = loop.tick(&plan);
  ASSERT_TRUE(r.setpoint);
  EXPECT_EQ(r.mode, SafetyMode::kTrack);
  const auto later = loop.run(0.2);
  ASSERT_TRUE(later.setpoint);
  EXPECT_NEAR(later.setpoint->position_enu_m.x(), 0.2, 1e-9);
  EXPECT_NEAR(later.setpoint->velocity_enu_m_s.x(), 1.0, 1e-9);
}

TEST(Gate, FliesTheOldPlanUntilTheNewOneStarts) {
  Loop loop;
  const auto first = straight_plan(1, 0.01), second = straight_plan(2, 0.06, 0.05);
  loop.tick(&first);
  EXPECT_EQ(loop.tick(&second).plan_id, 1U);
  loop.run(0.06);
  EXPECT_EQ(loop.tick().plan_id, 2U);
}

TEST(Gate, StepsDownFromTrackToCoastToHoverToSilentWhenPlansCease) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  EXPECT_EQ(loop.run(0.2).mode, SafetyMode::kTrack);
  const auto coast = loop.run(0.2);
  EXPECT_EQ(coast.mode, SafetyMode::kCoast);
  EXPECT_EQ(coast.reason, SafetyReason::kPlanStale);
  EXPECT_TRUE(coast.heartbeat);
  const auto hover = loop.run(3.0);
  EXPECT_EQ(hover.mode, SafetyMode::kHover);
  ASSERT_TRUE(hover.setpoint);
  EXPECT_NEAR(hover.setpoint->position_enu_m.x(), 2.5, 1e-9);
  EXPECT_EQ(hover.setpoint->velocity_enu_m_s, Vec3::Zero());
  const auto silent = loop.run(3.0);
  EXPECT_EQ(silent.mode, SafetyMode::kSilent);
  EXPECT_FALSE(silent.heartbeat);
  EXPECT_FALSE(silent.setpoint);
}

TEST(Gate, TracksAgainWhenPlansComeBack) {
  Loop loop;
  const auto first = straight_plan(1, 0.01);
  loop.tick(&first);
  loop.run(9.0);
  const auto second = straight_plan(2, loop.now_s + 0.01, 2.5);
  loop.tick(&second);
  EXPECT_EQ(loop.tick().mode, SafetyMode::kTrack);
}

TEST(Gate, PublishesNoSetpointOutsideOffboardModeButAsksForIt) {
  Loop loop;
  loop.offboard = false;
  const auto plan = straight_plan(1, 0.01);
  const auto r = loop.tick(&plan);
  EXPECT_FALSE(r.setpoint);
  EXPECT_TRUE(r.heartbeat);
  EXPECT_EQ(r.request, AutopilotRequest::kOffboard);
  EXPECT_EQ(r.reason, SafetyReason::kNotOffboard);
}

TEST(Gate, BrakesWhenTheVehicleIsFarOffItsTrajectory) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  loop.displaced = Vec3(0, 3, 1.5);
  const auto r = loop.tick();
  EXPECT_EQ(r.mode, SafetyMode::kBrake);
  ASSERT_TRUE(r.setpoint);
  EXPECT_TRUE(r.setpoint->position_enu_m.hasNaN());
  EXPECT_EQ(r.setpoint->velocity_enu_m_s, Vec3::Zero());
}

TEST(Gate, FallsSilentWithoutVehicleStateOrFlightController) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
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
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  MissionCommand hold{.id = 5, .stamp_s = loop.now_s, .order = MissionOrder::kHold};
  EXPECT_EQ(loop.tick(nullptr, &hold).phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.tick(nullptr, &hold).command_result, MissionResult::kRefusedRepeated);
  MissionCommand late{.id = 6, .stamp_s = loop.now_s - 5.0, .order = MissionOrder::kResume};
  EXPECT_EQ(loop.tick(nullptr, &late).command_result, MissionResult::kRefusedLate);
  MissionCommand stop{.id = 1, .stamp_s = loop.now_s - 5.0, .order = MissionOrder::kStop};
  EXPECT_EQ(loop.tick(nullptr, &stop).phase, MissionPhase::kStopped);
}

TEST(Gate, StopsByBrakingAndThenHoldsWhereItCameToRest) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  loop.vehicle.velocity_enu_m_s = Vec3(1, 0, 0);
  MissionCommand stop{.id = 1, .stamp_s = loop.now_s, .order = MissionOrder::kStop};
  EXPECT_EQ(loop.tick(nullptr, &stop).mode, SafetyMode::kBrake);
  loop.vehicle.velocity_enu_m_s = Vec3::Zero();
  loop.displaced = Vec3(0.3, 0, 1.5);
  const auto stopped = loop.tick();
  EXPECT_EQ(stopped.mode, SafetyMode::kHover);
  ASSERT_TRUE(stopped.setpoint);
  EXPECT_EQ(stopped.setpoint->position_enu_m, Vec3(0.3, 0, 1.5));
}

TEST(Gate, StartsTheWaitingPlanBeforeANewerOneTakesItsPlace) {
  Loop loop;
  const auto first = straight_plan(1, 0.01), second = straight_plan(2, 0.05, 0.04);
  loop.tick(&first);
  loop.tick(&second);
  loop.run(0.02);  // now 0.04 s: the second starts at the next tick, with which a third comes
  const auto third = straight_plan(3, 0.5, 0.49);
  EXPECT_EQ(loop.tick(&third).plan_id, 2U);
}

TEST(Gate, HoldsWhereItCameToRestAndNotWhereItHeldBeforeItWasPushedAway) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  ASSERT_EQ(loop.run(3.2).mode, SafetyMode::kHover);
  loop.displaced = Vec3(0, 4, 1.5);
  ASSERT_EQ(loop.tick().mode, SafetyMode::kBrake);
  MissionCommand hold{.id = 1, .stamp_s = loop.now_s, .order = MissionOrder::kHold};
  const auto r = loop.tick(nullptr, &hold);
  ASSERT_EQ(r.mode, SafetyMode::kHover);
  ASSERT_TRUE(r.setpoint);
  EXPECT_EQ(r.setpoint->position_enu_m, Vec3(0, 4, 1.5));
}

TEST(Gate, LandsThroughTheFlightControllerWithoutHeartbeat) {
  Loop loop;
  const auto plan = straight_plan(1, 0.01);
  loop.tick(&plan);
  MissionCommand land{.id = 1, .stamp_s = loop.now_s, .order = MissionOrder::kLand};
  const auto r = loop.tick(nullptr, &land);
  EXPECT_EQ(r.request, AutopilotRequest::kLand);
  EXPECT_FALSE(r.heartbeat);
}

}  // namespace
}  // namespace foretrack
