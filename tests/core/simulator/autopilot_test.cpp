// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/autopilot.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// An autopilot with a vehicle that stands where it is put.
struct Bench {
  VehicleState vehicle;
  Autopilot autopilot = make_autopilot({}, VehicleState{});

  Setpoint run(double for_s, const AutopilotInput& input) {
    Setpoint flown;
    for (int i = 0; i < std::lround(for_s / 0.01); ++i) {
      vehicle.stamp_s += 0.01;
      flown = update_autopilot(autopilot, input, vehicle, 0.01);
    }
    return flown;
  }
  bool offboard() const { return autopilot.status.offboard; }
};

AutopilotInput offboard_to(const Vec3& p) {
  AutopilotInput input;
  input.heartbeat = true;
  input.mode = AutopilotMode::kOffboard;
  input.setpoint = Setpoint{.position_enu_m = p};
  return input;
}

TEST(Autopilot, GrantsOffboardOnlyAfterASecondOfHeartbeat) {
  Bench bench;
  bench.run(0.9, offboard_to({1, 0, 0}));
  EXPECT_FALSE(bench.offboard());
  bench.run(0.2, offboard_to({1, 0, 0}));
  EXPECT_TRUE(bench.offboard());
}

TEST(Autopilot, ABrokenHeartbeatStartsTheSecondAnew) {
  Bench bench;
  bench.run(0.9, offboard_to({1, 0, 0}));
  bench.run(0.6, {});
  bench.run(0.9, offboard_to({1, 0, 0}));
  EXPECT_FALSE(bench.offboard());
}

TEST(Autopilot, AHeartbeatAtTwoHertzIsEnough) {
  Bench bench;
  AutopilotInput beat = offboard_to({1, 0, 0});
  for (int i = 0; i < 5; ++i) {
    bench.run(0.01, beat);
    AutopilotInput silent;
    silent.mode = AutopilotMode::kOffboard;
    bench.run(0.48, silent);
  }
  EXPECT_TRUE(bench.offboard());
}

TEST(Autopilot, IgnoresSetpointsOutsideOffboard) {
  Bench bench;
  AutopilotInput input = offboard_to({9, 9, 9});
  input.mode.reset();
  const Setpoint flown = bench.run(3.0, input);
  EXPECT_FALSE(bench.offboard());
  EXPECT_EQ(flown.position_enu_m, bench.vehicle.position_enu_m);
}

TEST(Autopilot, FliesTheLastSetpointOnWhileTheHeartbeatLasts) {
  Bench bench;
  bench.run(1.2, offboard_to({1, 2, 3}));
  AutopilotInput heartbeat_alone;
  heartbeat_alone.heartbeat = true;
  EXPECT_EQ(bench.run(5.0, heartbeat_alone).position_enu_m, Vec3(1, 2, 3));
  EXPECT_TRUE(bench.offboard());
}

TEST(Autopilot, ALostHeartbeatBrakesThenHoldsAndStaysSo) {
  Bench bench;
  bench.run(1.2, offboard_to({1, 2, 3}));
  bench.vehicle.position_enu_m = {5, 0, 2};
  bench.vehicle.velocity_enu_m_s = {2, 0, 0};
  const Setpoint braking = bench.run(0.7, {});
  EXPECT_TRUE(bench.autopilot.status.failsafe);
  EXPECT_FALSE(bench.offboard());
  EXPECT_TRUE(braking.position_enu_m.hasNaN());
  EXPECT_EQ(braking.velocity_enu_m_s, Vec3::Zero());
  bench.vehicle.velocity_enu_m_s.setZero();
  EXPECT_EQ(bench.run(0.1, {}).position_enu_m, Vec3(5, 0, 2));
  AutopilotInput heartbeat_alone;
  heartbeat_alone.heartbeat = true;
  bench.run(3.0, heartbeat_alone);
  EXPECT_FALSE(bench.offboard()) << "returned without a request";
  bench.run(0.1, offboard_to({1, 2, 3}));
  EXPECT_TRUE(bench.offboard());
  EXPECT_FALSE(bench.autopilot.status.failsafe);
}

TEST(Autopilot, LandsAndDisarmsOnTheGround) {
  Bench bench;
  bench.vehicle.position_enu_m = {1, 1, 2};
  AutopilotInput land;
  land.mode = AutopilotMode::kLand;
  const Setpoint flown = bench.run(0.1, land);
  EXPECT_LT(flown.velocity_enu_m_s.z(), 0.0);
  EXPECT_TRUE(bench.autopilot.status.armed);
  bench.vehicle.position_enu_m.z() = 0.0;
  bench.run(0.1, {});
  EXPECT_FALSE(bench.autopilot.status.armed);
}

TEST(Autopilot, ReturnsHomeThenLands) {
  Bench bench;
  bench.vehicle.position_enu_m = {10, 0, 2};
  AutopilotInput go_home;
  go_home.mode = AutopilotMode::kReturn;
  bench.run(0.01, go_home);
  for (int i = 0; i < 600; ++i) bench.vehicle.position_enu_m = bench.run(0.01, {}).position_enu_m;
  EXPECT_EQ(bench.autopilot.mode, AutopilotMode::kLand);
}

}  // namespace
}  // namespace foretrack
