// SPDX-License-Identifier: Apache-2.0
// Odometry that jumps, freezes, contradicts itself, or comes with stamps that cannot be.
#include "core/safety/watch_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

struct FlyingOdometry : FlightLoop {
  FlyingOdometry() {
    take_off_and_track();
    const auto plan = straight_plan(++last_plan, stamp_now_s() + kTick_s);
    tick(&plan);
    run(0.2);
    EXPECT_EQ(result.mode, SafetyMode::kTrack);
  }
  void go_on() {
    const auto plan = still_plan(++last_plan, stamp_now_s() + kTick_s, vehicle.position_enu_m);
    tick(&plan);
  }
};

TEST(WatchOdometry, AJumpBrakesAndIsSaidUntilTheOdometryHasSettled) {
  FlyingOdometry loop;
  loop.displaced = loop.vehicle.position_enu_m + Vec3(0, 5, 0);
  loop.tick();
  EXPECT_EQ(loop.result.mode, SafetyMode::kBrake);
  EXPECT_EQ(loop.result.reason, SafetyReason::kOdometryJumps);
  for (int i = 0; i < 100; ++i) {
    loop.go_on();
    EXPECT_EQ(loop.result.mode, SafetyMode::kBrake) << "a new plan does not make it good";
  }
  loop.run_with_plans(4.0);
  EXPECT_EQ(loop.result.mode, SafetyMode::kTrack);
}

TEST(WatchOdometry, AJumpOfASmallUpdateIsNone) {
  FlyingOdometry loop;
  loop.displaced = loop.vehicle.position_enu_m + Vec3(0, 0.3, 0);
  EXPECT_EQ(loop.tick().mode, SafetyMode::kTrack);
}

TEST(WatchOdometry, FrozenWithNewStampsBrakesOnceMotionIsCommanded) {
  FlyingOdometry loop;
  loop.displaced = loop.vehicle.position_enu_m;
  double braked_s = -1.0;
  for (int i = 0; i < 300 && braked_s < 0.0; ++i)
    if (loop.tick().reason == SafetyReason::kOdometryFrozen) braked_s = 0.01 * i;
  EXPECT_GT(braked_s, 0.5);
  EXPECT_LT(braked_s, 1.5);
  EXPECT_EQ(loop.result.mode, SafetyMode::kBrake);
}

TEST(WatchOdometry, AFastCommandGivesTheVehicleTimeToBeginToMove) {
  OdometryWatch watch;
  const OdometryParams params;
  const Vec3 commanded_m_s(10.0, 0.0, 0.0);
  double now_s = 1.0;
  for (; now_s < 1.4; now_s += 0.01)
    EXPECT_EQ(watch_odometry(watch, commanded_m_s, 0.01, now_s, params), OdometryFault::kNone);
  EXPECT_GT(watch.commanded_m, params.frozen_path_m);
  for (; now_s < 1.6; now_s += 0.01) watch_odometry(watch, commanded_m_s, 0.01, now_s, params);
  EXPECT_EQ(watch.fault, OdometryFault::kFrozen);
}

TEST(WatchOdometry, AFrozenOneIsBelievedAgainWhenItStirsAndNotBefore) {
  FlyingOdometry loop;
  loop.displaced = loop.vehicle.position_enu_m;
  loop.run(1.8);
  ASSERT_EQ(loop.result.reason, SafetyReason::kOdometryFrozen);
  loop.run_with_plans(20.0);
  EXPECT_EQ(loop.result.reason, SafetyReason::kOdometryFrozen);
  *loop.displaced += Vec3(0.002, 0, 0);
  loop.run_with_plans(2.0);
  EXPECT_EQ(loop.result.mode, SafetyMode::kTrack);
}

TEST(WatchOdometry, AVehicleThatHoversIsNotFrozen) {
  FlightLoop loop;
  loop.take_off_and_track();
  EXPECT_EQ(loop.run_with_plans(60.0).mode, SafetyMode::kTrack);
}

TEST(WatchOdometry, DisagreementWithItsOwnVelocityBrakes) {
  OdometryWatch watch;
  VehicleState state;
  state.velocity_enu_m_s = Vec3(1.0, 0.0, 0.0);  // but the position stays
  OdometryFault fault = OdometryFault::kNone;
  double at_s = 0.0;
  for (; at_s < 3.0 && fault == OdometryFault::kNone; at_s += 0.01) {
    state.stamp_s = at_s;
    take_odometry(watch, state, at_s, {at_s, at_s}, {});
    fault = watch_odometry(watch, Vec3::Zero(), 0.01, at_s, {});
  }
  EXPECT_EQ(fault, OdometryFault::kDisagrees);
  EXPECT_LT(at_s, 1.0);
}

// A machine that is busy hands states on late, now more, now less.
TEST(WatchOdometry, StatesThatWereLateOnTheWayDoNotDisagree) {
  OdometryWatch watch;
  VehicleState state;
  state.velocity_enu_m_s = Vec3(2.5, 0.0, 0.0);
  double at_s = 0.0;
  for (int i = 0; i < 1000; ++i) {
    state.stamp_s = 0.01 * i;
    state.position_enu_m.x() = 2.5 * state.stamp_s;
    at_s = std::max(at_s + 1e-4, state.stamp_s + (i / 40 % 2 ? 0.25 : 0.01));
    take_odometry(watch, state, at_s, {at_s, at_s}, {});
    EXPECT_EQ(watch_odometry(watch, Vec3::Zero(), 0.01, at_s, {}), OdometryFault::kNone) << i;
  }
}

/// States that come each 10 ms, and what becomes of one among them.
struct Stream {
  OdometryWatch watch;
  double now_s = 10.0, clock_s = 1000.0;  // monotonic, and of stamps
  OdometryParams params;

  bool take(double stamp_s) {
    VehicleState state;
    state.stamp_s = stamp_s;
    const auto refused = watch.refused;
    take_odometry(watch, state, now_s, {now_s, clock_s}, params);
    return watch.refused == refused && watch.state.stamp_s == stamp_s;
  }
  bool tick(double age_s = 0.005) {
    now_s += 0.01;
    clock_s += 0.01;
    return take(clock_s - age_s);
  }
};

TEST(WatchOdometry, OldStampsDoNotReplaceNewerOnes) {
  Stream stream;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(stream.tick());
    EXPECT_FALSE(stream.tick(5.0));
    EXPECT_FALSE(stream.tick(0.06)) << "overtaken";
  }
  Stream first;
  EXPECT_FALSE(first.tick(5.0));
  EXPECT_TRUE(first.tick());
}

TEST(WatchOdometry, StampsAheadDoNotShutHonestOnesOut) {
  Stream stream;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(stream.tick());
    EXPECT_FALSE(stream.tick(-0.45));
  }
}

TEST(WatchOdometry, AClockThatIsSetDoesNotMatterWhoeversItIs) {
  for (const double step_s : {-3600.0, -0.45, 0.45, 3600.0}) {
    Stream ours;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(ours.tick());
    ours.clock_s += step_s;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(ours.tick(0.005 + step_s)) << "their stamps go on";
    Stream both;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(both.tick());
    both.clock_s += step_s;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(both.tick());
  }
}

TEST(WatchOdometry, ASourceWithASlowClockIsHeardOn) {
  Stream stream;
  for (int i = 0; i < 2000; ++i) EXPECT_TRUE(stream.tick(0.005 + 0.035 * 0.01 * i));
}

TEST(WatchOdometry, RefusesWhatIsNotFinite) {
  for (int i = 0; i < 5; ++i) {
    OdometryWatch watch;
    VehicleState state;
    state.stamp_s = 1.0;
    if (i == 0) state.stamp_s = std::nan("");
    if (i == 1) state.position_enu_m.x() = std::nan("");
    if (i == 2) state.velocity_enu_m_s.x() = INFINITY;
    if (i == 3) state.q_world_body.w() = std::nan("");
    if (i == 4) state.angular_velocity_body_rad_s.z() = std::nan("");
    take_odometry(watch, state, 1.0, {1.0, 1.0}, {});
    EXPECT_LT(watch.at_s, 0.0) << i;
    EXPECT_EQ(watch.refused, 1U);
    take_odometry(watch, state, 1.0, {1.1, 1.1}, {});
    EXPECT_EQ(watch.refused, 1U) << "counted once";
    take_odometry(watch, state, -1.0, {1.1, 1.1}, {});
    EXPECT_EQ(watch.refused, 1U) << "never came";
  }
}

}  // namespace
}  // namespace foretrack::testing
