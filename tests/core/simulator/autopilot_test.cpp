// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/autopilot.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using enum FlightMode;

VehicleState at(const Vec3& position_enu_m) {
  VehicleState vehicle;
  vehicle.position_enu_m = position_enu_m;
  return vehicle;
}

// An autopilot with a vehicle that stands where it is put.
struct Bench {
  explicit Bench(std::vector<Incident> incidents = {}, const Vec3& position_enu_m = {0, 0, 2})
      : vehicle(at(position_enu_m)),
        autopilot(make_autopilot({.incidents = std::move(incidents)}, vehicle)) {}

  VehicleState vehicle;
  Autopilot autopilot;

  Setpoint run(double for_s, const AutopilotInput& input) {
    Setpoint flown;
    for (int i = 0; i < std::lround(for_s / 0.01); ++i) {
      vehicle.stamp_s += 0.01;
      flown = update_autopilot(autopilot, input, vehicle, 0.01);
    }
    return flown;
  }
  // The same with a vehicle that is at once where it is told to be.
  void follow(double for_s, const AutopilotInput& input) {
    for (int i = 0; i < std::lround(for_s / 0.01); ++i) {
      const Setpoint flown = run(0.01, input);
      if (!motors_turn(autopilot)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        if (!std::isnan(flown.position_enu_m[axis]))
          vehicle.position_enu_m[axis] = flown.position_enu_m[axis];
        else
          vehicle.position_enu_m[axis] += 0.01 * flown.velocity_enu_m_s[axis];
      }
      vehicle.position_enu_m.z() = std::max(0.0, vehicle.position_enu_m.z());
    }
  }
  // The answer to one command.
  std::optional<CommandResult> order(const AutopilotCommand& command, bool heartbeat = false) {
    run(0.01, {.heartbeat = heartbeat, .setpoint = {}, .command = command});
    return autopilot.answer;
  }
  bool offboard() const { return autopilot.status.offboard; }
  const AutopilotStatus& status() const { return autopilot.status; }
};

constexpr AutopilotCommand kArmIt{.kind = CommandKind::kArm};
constexpr AutopilotCommand kDisarmIt{.kind = CommandKind::kDisarm};
AutopilotCommand go(FlightMode mode) {
  return {.mode = mode};
}

const AutopilotInput kHeartbeat{.heartbeat = true, .setpoint = {}, .command = {}};

AutopilotInput offboard_to(const Vec3& p) {
  return {.heartbeat = true, .setpoint = Setpoint{.position_enu_m = p}, .command = go(kOffboard)};
}

TEST(Autopilot, GrantsOffboardOnlyAfterASecondOfHeartbeat) {
  Bench bench;
  bench.run(0.9, offboard_to({1, 0, 0}));
  EXPECT_FALSE(bench.offboard());
  EXPECT_EQ(bench.autopilot.answer, CommandResult::kTemporarilyRejected);
  bench.run(0.2, offboard_to({1, 0, 0}));
  EXPECT_TRUE(bench.offboard());
  EXPECT_EQ(bench.autopilot.answer, CommandResult::kAccepted);
}

TEST(Autopilot, ABrokenHeartbeatStartsTheSecondAnew) {
  Bench bench;
  bench.run(0.9, offboard_to({1, 0, 0}));
  bench.run(1.1, {});
  bench.run(0.9, offboard_to({1, 0, 0}));
  EXPECT_FALSE(bench.offboard());
}

TEST(Autopilot, AHeartbeatAtTwoHertzIsEnough) {
  Bench bench;
  AutopilotInput beat = offboard_to({1, 0, 0});
  for (int i = 0; i < 5; ++i) {
    bench.run(0.01, beat);
    AutopilotInput silent;
    silent.command = go(kOffboard);
    bench.run(0.48, silent);
  }
  EXPECT_TRUE(bench.offboard());
}

TEST(Autopilot, IgnoresSetpointsOutsideOffboard) {
  Bench bench;
  AutopilotInput input = offboard_to({9, 9, 9});
  input.command.reset();
  const Setpoint flown = bench.run(3.0, input);
  EXPECT_FALSE(bench.offboard());
  EXPECT_EQ(flown.position_enu_m, bench.vehicle.position_enu_m);
}

TEST(Autopilot, FliesTheLastSetpointOnWhileTheHeartbeatLasts) {
  Bench bench;
  bench.run(1.2, offboard_to({1, 2, 3}));
  EXPECT_EQ(bench.run(5.0, kHeartbeat).position_enu_m, Vec3(1, 2, 3));
  EXPECT_TRUE(bench.offboard());
}

TEST(Autopilot, ALostHeartbeatBrakesThenHoldsAndStaysSo) {
  Bench bench;
  bench.run(1.2, offboard_to({1, 2, 3}));
  bench.vehicle.position_enu_m = {5, 0, 2};
  bench.vehicle.velocity_enu_m_s = {2, 0, 0};
  const Setpoint braking = bench.run(1.2, {});
  EXPECT_TRUE(bench.status().failsafe);
  EXPECT_FALSE(bench.offboard());
  EXPECT_TRUE(braking.position_enu_m.hasNaN());
  EXPECT_EQ(braking.velocity_enu_m_s, Vec3::Zero());
  bench.vehicle.velocity_enu_m_s.setZero();
  EXPECT_EQ(bench.run(0.1, {}).position_enu_m, Vec3(5, 0, 2));
  bench.run(3.0, kHeartbeat);
  EXPECT_FALSE(bench.offboard()) << "returned without a request";
  bench.run(0.1, offboard_to({1, 2, 3}));
  EXPECT_TRUE(bench.offboard());
  EXPECT_FALSE(bench.status().failsafe);
}

TEST(Autopilot, LandsAndDisarmsOnTheGround) {
  Bench bench({}, {1, 1, 2});
  EXPECT_EQ(bench.order(go(kLand)), CommandResult::kAccepted);
  const Setpoint flown = bench.run(0.1, {});
  EXPECT_LT(flown.velocity_enu_m_s.z(), 0.0);
  EXPECT_TRUE(bench.status().armed);
  bench.vehicle.position_enu_m.z() = 0.0;
  bench.run(0.1, {});
  EXPECT_FALSE(bench.status().armed);
}

TEST(Autopilot, ReturnsHomeThenLands) {
  Bench bench;
  bench.vehicle.position_enu_m = {10, 0, 2};
  bench.order(go(kReturn));
  bench.follow(6.0, {});
  EXPECT_EQ(bench.status().mode, kLand);
  bench.follow(6.0, {});
  EXPECT_FALSE(bench.status().armed);
  EXPECT_LT(bench.vehicle.position_enu_m.head<2>().norm(), 0.31);
}

TEST(Autopilot, IgnoresCommandsToAnotherSystemWithoutAWord) {
  Bench bench({}, {0, 0, 0});
  AutopilotCommand command = kArmIt;
  command.target_system = 2;
  EXPECT_EQ(bench.order(command), std::nullopt);
  EXPECT_FALSE(bench.status().armed);
  command.target_system = 0;  // to whoever hears it
  EXPECT_EQ(bench.order(command), CommandResult::kAccepted);
}

TEST(Autopilot, BeginsDisarmedOnTheGroundAndTakesOffOnOrder) {
  Bench bench({}, {3, 1, 0});
  bench.run(1.0, {});
  EXPECT_FALSE(motors_turn(bench.autopilot));
  EXPECT_EQ(bench.order(go(kTakeOff)), CommandResult::kAccepted);
  bench.follow(2.0, {});
  EXPECT_EQ(bench.vehicle.position_enu_m, Vec3(3, 1, 0)) << "took off disarmed";
  EXPECT_EQ(bench.order(kArmIt), CommandResult::kAccepted);
  bench.follow(4.0, {});
  EXPECT_NEAR(bench.vehicle.position_enu_m.z(), bench.autopilot.params.takeoff_height_m, 0.31);
  EXPECT_EQ(bench.status().mode, kHold);
}

TEST(Autopilot, TakesEveryModeWhileDisarmedButArmsOnlyWhereItCanFlyIt) {
  Bench bench({}, {0, 0, 0});
  EXPECT_EQ(bench.order(go(kOffboard)), CommandResult::kAccepted);
  EXPECT_EQ(bench.order(kArmIt), CommandResult::kTemporarilyRejected);
  bench.run(1.1, kHeartbeat);
  EXPECT_EQ(bench.order(kArmIt, true), CommandResult::kAccepted);
  EXPECT_TRUE(bench.offboard() && bench.status().armed);
}

TEST(Autopilot, DisarmsOnTheGroundWhenNobodyTakesOff) {
  Bench bench({}, {0, 0, 0});
  bench.order(kArmIt);
  bench.run(9.9, {});
  EXPECT_TRUE(bench.status().armed);
  bench.run(0.2, {});
  EXPECT_FALSE(bench.status().armed);
}

TEST(Autopilot, DisarmsInTheAirByForceAlone) {
  Bench bench;
  EXPECT_EQ(bench.order(kDisarmIt), CommandResult::kTemporarilyRejected);
  EXPECT_TRUE(motors_turn(bench.autopilot));
  AutopilotCommand forced = kDisarmIt;
  forced.forced = true;
  EXPECT_EQ(bench.order(forced), CommandResult::kAccepted);
  EXPECT_FALSE(motors_turn(bench.autopilot));
}

TEST(Autopilot, AFailsafeActsAndGoesBackWhenItIsOver) {
  for (const auto& [kind, mode] :
       {std::pair(IncidentKind::kGeofence, kHold), std::pair(IncidentKind::kBattery, kReturn),
        std::pair(IncidentKind::kLink, kReturn)}) {
    Bench bench({{2.0, kind, kPilot}, {3.0, IncidentKind::kWell, kPilot}}, {9, 0, 2});
    bench.autopilot.home_enu_m = {0, 0, 2};
    bench.run(1.5, offboard_to({9, 0, 2}));
    bench.run(1.0, kHeartbeat);
    EXPECT_TRUE(bench.status().failsafe && !bench.offboard());
    EXPECT_EQ(bench.status().mode, mode);
    bench.run(1.0, kHeartbeat);
    EXPECT_TRUE(!bench.status().failsafe && bench.offboard());
  }
}

TEST(Autopilot, ARequestDuringAFailsafeCountsAsATakeoverAndEndsIt) {
  Bench bench({{2.0, IncidentKind::kBattery, kPilot}}, {9, 0, 2});
  bench.run(1.5, offboard_to({9, 0, 2}));
  bench.run(1.0, kHeartbeat);
  ASSERT_TRUE(bench.status().failsafe);
  EXPECT_EQ(bench.order(go(kOffboard), true), CommandResult::kAccepted);
  EXPECT_TRUE(bench.offboard() && bench.status().user_took_over && !bench.status().failsafe);
}

TEST(Autopilot, APilotTakesOverByModeOrSticks) {
  Bench bench({{2.0, IncidentKind::kMode, kOther}, {4.0, IncidentKind::kSticks, kPilot}});
  bench.run(1.5, offboard_to({0, 0, 2}));
  bench.run(1.0, kHeartbeat);
  EXPECT_EQ(bench.status().mode, kOther);
  EXPECT_TRUE(bench.status().armed && !bench.status().failsafe);
  bench.run(0.5, offboard_to({0, 0, 2}));  // asked again, it takes offboard from the pilot
  EXPECT_TRUE(bench.offboard());
  bench.run(1.01, kHeartbeat);
  EXPECT_EQ(bench.status().mode, kPilot);
  EXPECT_TRUE(bench.status().sticks_moved);
  bench.run(0.01, kHeartbeat);
  EXPECT_FALSE(bench.status().sticks_moved);
}

TEST(Autopilot, NothingLeadsOutOfTermination) {
  Bench bench({{1.0, IncidentKind::kTerminate, kPilot}});
  bench.run(1.5, kHeartbeat);
  EXPECT_EQ(bench.status().mode, kTermination);
  EXPECT_FALSE(motors_turn(bench.autopilot));
  EXPECT_EQ(bench.order(go(kOffboard), true), CommandResult::kTemporarilyRejected);
  EXPECT_EQ(bench.order(go(kLand)), CommandResult::kTemporarilyRejected);
  bench.vehicle.position_enu_m.z() = 0.0;
  bench.order({.kind = CommandKind::kDisarm, .forced = true});
  EXPECT_EQ(bench.order(kArmIt), CommandResult::kTemporarilyRejected);
  EXPECT_EQ(bench.status().mode, kTermination);
}

TEST(Autopilot, ReturnsToTheHomeThatItWasToldLast) {
  Bench bench;
  bench.run(0.01, {.setpoint = {}, .home_enu_m = Vec3(3.0, -2.0, 50.0)});
  EXPECT_EQ(bench.autopilot.answer, CommandResult::kAccepted);
  EXPECT_EQ(bench.autopilot.home_enu_m, Vec3(3.0, -2.0, 2.0)) << "heights are its own";
  ASSERT_EQ(bench.order(go(kReturn)), CommandResult::kAccepted);
  bench.follow(20.0, {});
  EXPECT_LT(distance_xy(bench.vehicle.position_enu_m, Vec3(3.0, -2.0, 0.0)), 0.5);
  EXPECT_FALSE(bench.status().armed) << "it has landed there";
}

TEST(Autopilot, DeniesOrIgnoresCommandsWhereItIsToldTo) {
  Bench bench({{1.0, IncidentKind::kDeny, kPilot},
               {2.0, IncidentKind::kIgnore, kPilot},
               {3.0, IncidentKind::kObey, kPilot}});
  bench.run(1.1, {});
  EXPECT_EQ(bench.order(go(kLand)), CommandResult::kDenied);
  const AutopilotInput another_home{.setpoint = {}, .home_enu_m = Vec3(9.0, 9.0, 0.0)};
  bench.run(0.01, another_home);
  EXPECT_EQ(bench.autopilot.answer, CommandResult::kDenied);
  bench.run(1.0, {});
  EXPECT_EQ(bench.order(go(kLand)), std::nullopt);
  bench.run(0.01, another_home);
  EXPECT_EQ(bench.autopilot.answer, std::nullopt);
  EXPECT_EQ(bench.autopilot.home_enu_m.x(), 0.0);
  EXPECT_EQ(bench.status().mode, kHold);
  bench.run(1.0, {});
  EXPECT_EQ(bench.order(go(kLand)), CommandResult::kAccepted);
}

}  // namespace
}  // namespace foretrack
