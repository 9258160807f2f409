// SPDX-License-Identifier: Apache-2.0
// Fence, altitudes, battery and link, each with its reaction.
#include "core/safety/watch_limits.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

using Request = AutopilotRequest;

struct FlightAtLimits : FlightLoop {
  FlightAtLimits() {
    take_off_and_track();
    EXPECT_EQ(result.mode, SafetyMode::kTrack);
    autopilot.asked = {};
  }
};

FlightBounds fence() {
  FlightBounds bounds;
  bounds.corner_count = 4;
  bounds.corners_enu_m = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  return bounds;
}

TEST(WatchLimits, OutsideOfTheFenceItHoldsUntilItIsWellInsideAgain) {
  FlightAtLimits loop;
  loop.state.mission.bounds = fence();
  loop.vehicle.position_enu_m.x() = 0.0;
  EXPECT_EQ(loop.run_with_plans(1.0).mode, SafetyMode::kTrack);
  for (double x_m = 0.1; x_m < 2.15; x_m += 0.1) {  // pushed by the wind
    loop.displaced = Vec3(x_m, 0, 1.5);
    loop.run_with_plans(0.4);
  }
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_EQ(loop.result.reason, SafetyReason::kFence);
  loop.displaced = Vec3(1.9, 0, 1.5);  // inside, but not by much
  loop.run_with_plans(5.0);
  EXPECT_EQ(loop.result.reason, SafetyReason::kFence);
  loop.displaced = Vec3(1.6, 0, 1.5);
  loop.run_with_plans(5.0);
  EXPECT_EQ(loop.result.mode, SafetyMode::kTrack);
  EXPECT_EQ(loop.autopilot.total(), 0);
}

TEST(WatchLimits, AtTheFencesEdgeItDoesNotFlicker) {
  FlightAtLimits loop;
  loop.state.mission.bounds = fence();
  for (double x_m = 0.1; x_m < 2.0; x_m += 0.1) {
    loop.displaced = Vec3(x_m, 0, 1.5);
    loop.run_with_plans(0.4);
  }
  int changes = 0;
  SafetyMode before = loop.result.mode;
  for (int i = 0; i < 200; ++i) {
    loop.displaced = Vec3(i % 8 < 4 ? 1.97 : 2.03, 0, 1.5);
    loop.run_with_plans(0.1);
    changes += loop.result.mode != before;
    before = loop.result.mode;
  }
  EXPECT_LE(changes, 2);
}

TEST(WatchLimits, OutsideOfTheAltitudesItHoldsButBeginsOnTheGround) {
  FlightLoop ground;
  ground.params.altitude_min_m = 1.0;
  ground.vehicle.position_enu_m.z() = 0.0;
  ground.take_off_and_track();
  EXPECT_EQ(ground.result.mode, SafetyMode::kTrack);
  FlightAtLimits loop;
  loop.params.altitude_min_m = 1.0;
  loop.run_with_plans(0.5);
  for (double z_m = 1.5; z_m > 0.9; z_m -= 0.1) {
    loop.displaced = Vec3(0, 0, z_m);
    loop.run_with_plans(0.4);
  }
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.reason, SafetyReason::kAltitude);
  FlightAtLimits high;
  high.params.altitude_max_m = 1.4;
  high.state.limits = {};  // as of a gate that was started again
  EXPECT_EQ(high.run_with_plans(1.0).reason, SafetyReason::kAltitude);
}

TEST(WatchLimits, AltitudesCountFromTheGroundBelowAsItWasSeenLast) {
  FlightAtLimits loop;
  loop.params.altitude_min_m = 1.0;
  EXPECT_EQ(loop.run_with_plans(1.0).mode, SafetyMode::kTrack);
  GridMap higher = open_map();
  const auto layer = static_cast<std::ptrdiff_t>(higher.size.x()) * higher.size.y();
  std::fill_n(higher.cells.begin(), 3 * layer, static_cast<std::uint8_t>(Cell::kOccupied));
  loop.extra.map = &higher;  // by 0.75 m
  EXPECT_EQ(loop.run_with_plans(1.0).reason, SafetyReason::kAltitude);
  GridMap unseen = open_map();
  std::fill_n(unseen.cells.begin(), 3 * layer, static_cast<std::uint8_t>(Cell::kUnknown));
  loop.extra.map = &unseen;
  EXPECT_EQ(loop.run_with_plans(5.0).reason, SafetyReason::kAltitude);
  loop.extra.map = &open_map();
  EXPECT_EQ(loop.run_with_plans(5.0).mode, SafetyMode::kTrack);
}

TEST(WatchLimits, AtTheBatterysReserveItIsSentHomeOnce) {
  FlightAtLimits loop;
  BatteryState battery;
  loop.extra.battery = &battery;
  battery.remaining = 0.2;
  EXPECT_EQ(loop.run_with_plans(1.0).mode, SafetyMode::kTrack);
  battery.remaining = 0.14;
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kReturning);
  EXPECT_EQ(loop.result.limit.kind, LimitKind::kBattery);
  EXPECT_EQ(loop.result.end, MissionEnd::kBattery);
  loop.run_with_plans(20.0);
  EXPECT_EQ(loop.autopilot.count(Request::kReturn), 1);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST(WatchLimits, TheReactionIsAParameterAndNoneIsOne) {
  BatteryState battery;
  battery.remaining = 0.05;
  FlightAtLimits land, none, off;
  land.params.battery_reaction = static_cast<int>(Reaction::kLand);
  none.params.battery_reaction = static_cast<int>(Reaction::kNone);
  off.params.battery_reserve = 0.0;
  for (FlightLoop* loop : {static_cast<FlightLoop*>(&land), static_cast<FlightLoop*>(&none),
                           static_cast<FlightLoop*>(&off)}) {
    loop->extra.battery = &battery;
    loop->run_with_plans(1.0);
  }
  EXPECT_EQ(land.result.phase, MissionPhase::kLanding);
  EXPECT_EQ(land.autopilot.count(Request::kLand), 1);
  EXPECT_EQ(none.result.mode, SafetyMode::kTrack);
  EXPECT_EQ(off.result.mode, SafetyMode::kTrack);
}

TEST(WatchLimits, WithoutAStationItFliesUnlessOneWasAskedFor) {
  FlightAtLimits alone;
  EXPECT_EQ(alone.run_with_plans(60.0).mode, SafetyMode::kTrack);
  FlightAtLimits asked;
  asked.params.link_timeout_s = 2.0;
  asked.state.limits.since_s = asked.now_s;
  EXPECT_EQ(asked.run_with_plans(1.9).mode, SafetyMode::kTrack);
  EXPECT_EQ(asked.run_with_plans(1.0).reason, SafetyReason::kLink);
  for (int i = 0; i < 100; ++i) {
    asked.extra.operator_at_s = asked.now_s;
    asked.run_with_plans(0.1);
  }
  EXPECT_EQ(asked.result.mode, SafetyMode::kTrack);
}

TEST(WatchLimits, EachLimitSendsItHomeOrDownAndSaysWhy) {
  FlightAtLimits link;
  link.params.link_timeout_s = 2.0;
  link.params.link_reaction = static_cast<int>(Reaction::kReturn);
  link.run_with_plans(5.0);
  EXPECT_EQ(link.result.phase, MissionPhase::kReturning);
  EXPECT_EQ(link.result.end, MissionEnd::kLink);
  FlightAtLimits fenced;
  fenced.params.fence_reaction = static_cast<int>(Reaction::kLand);
  fenced.state.mission.bounds = fence();
  for (double x_m = 0.1; x_m < 2.15; x_m += 0.1) {
    fenced.displaced = Vec3(x_m, 0, 1.5);
    fenced.run_with_plans(0.4);
  }
  EXPECT_EQ(fenced.result.phase, MissionPhase::kLanding);
  EXPECT_EQ(fenced.result.end, MissionEnd::kFence);
  EXPECT_EQ(fenced.autopilot.total(), 1);
}

TEST(WatchLimits, AHoldingMissionIsNotSentHomeByALimit) {
  FlightAtLimits loop;
  BatteryState battery;
  battery.remaining = 0.05;
  loop.order(MissionOrder::kHold);
  loop.extra.battery = &battery;
  EXPECT_EQ(loop.run_with_plans(5.0).phase, MissionPhase::kHolding);
}

}  // namespace
}  // namespace foretrack::testing
