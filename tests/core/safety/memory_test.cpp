// SPDX-License-Identifier: Apache-2.0
// What survives a kill of the gate, and what is confirmed when.
#include "core/safety/memory.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

/// The gate is killed and comes back with what it had written.
void kill_and_restart(FlightLoop& loop, bool with_file = true) {
  const GateMemory memory = loop.state.memory;
  loop.state = GateState();
  if (with_file) restore(loop.state, memory, loop.now_s, loop.params);
}

TEST(Memory, AStoppedMissionStaysStoppedAfterAKill) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kStop);
  loop.autopilot.asked = {};
  kill_and_restart(loop);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_EQ(loop.order(MissionOrder::kResume).command_result, MissionResult::kRefusedPhase);
}

TEST(Memory, AHoldingMissionHoldsAfterAKill) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kHold);
  kill_and_restart(loop);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
}

TEST(Memory, ATrackingMissionHoldsUnderOffboardAfterAKillAndResumesOnlyOnOrder) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.asked = {};
  kill_and_restart(loop);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_EQ(loop.order(MissionOrder::kResume).phase, MissionPhase::kTracking);
}

TEST(Memory, ATrackingMissionIsIdleAfterAKillWhenOffboardWasLeftMeanwhile) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.asked = {};
  loop.autopilot.enter(FlightMode::kHold);
  kill_and_restart(loop);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_FALSE(loop.result.heartbeat);
}

TEST(Memory, ALandingIsLeftToTheFlightControllerAfterAKill) {
  for (const auto order : {MissionOrder::kLand, MissionOrder::kReturn}) {
    FlightLoop loop;
    loop.take_off_and_track();
    loop.order(order);
    loop.run(1.0);
    loop.autopilot.asked = {};
    kill_and_restart(loop);
    loop.run_with_plans(10.0);
    EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
    EXPECT_EQ(loop.autopilot.total(), 0);
    EXPECT_FALSE(loop.result.heartbeat);
  }
}

TEST(Memory, WithoutItsFileTheGateIsIdle) {
  for (const auto order : {MissionOrder::kStop, MissionOrder::kHold, MissionOrder::kLand}) {
    FlightLoop loop;
    loop.take_off_and_track();
    loop.order(order);
    loop.autopilot.asked = {};
    kill_and_restart(loop, false);
    loop.run_with_plans(10.0);
    EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
    EXPECT_EQ(loop.autopilot.total(), 0);
    EXPECT_FALSE(loop.result.heartbeat);
  }
}

TEST(Memory, KeepsTheLeaseTheBoundsAndTheLastOrderAcrossAKill) {
  FlightLoop loop;
  loop.order(MissionOrder::kLease, "ada");
  MissionCommand bounds{.id = ++loop.last_order,
                        .stamp_s = loop.stamp_now_s(),
                        .order = MissionOrder::kSetBounds,
                        .lease_id = "ada",
                        .proved = true};
  bounds.bounds.altitude_max_m = 12.0;
  ASSERT_EQ(loop.tick(nullptr, &bounds).command_result, MissionResult::kAccepted);
  kill_and_restart(loop);
  EXPECT_EQ(loop.state.mission.bounds.altitude_max_m, 12.0);
  EXPECT_EQ(loop.state.mission.lease.operator_name.view(), "ada");
  EXPECT_EQ(loop.tick(nullptr, &bounds).command_result, MissionResult::kRefusedRepeated);
  EXPECT_EQ(loop.order(MissionOrder::kStart, "bob").command_result, MissionResult::kRefusedForeign);
  EXPECT_EQ(loop.order(MissionOrder::kLease, "ada").command_result, MissionResult::kAccepted);
  loop.run(loop.params.lease_s + 0.1);
  EXPECT_EQ(loop.order(MissionOrder::kLease, "bob").command_result, MissionResult::kAccepted);
}

TEST(Memory, OfAnotherVersionOrDamagedIsAsNone) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kStop);
  const GateMemory good = loop.state.memory;
  ASSERT_EQ(mission_of(good, 0.0, {}).phase, MissionPhase::kStopped);
  GateMemory bad[5] = {good, good, good, good, good};
  bad[0].version = 2;
  bad[1].phase = static_cast<MissionPhase>(99);
  bad[2].lease_id.length = 200;
  bad[3].lease_operator.length = 200;
  bad[4].bounds.corner_count = 1000;
  for (const GateMemory& memory : bad)
    EXPECT_EQ(mission_of(memory, 0.0, {}).phase, MissionPhase::kIdle);
}

TEST(Memory, TheRenewalOfALeaseIsNothingToWrite) {
  FlightLoop loop;
  EXPECT_TRUE(loop.order(MissionOrder::kLease).memory_changed);
  const auto revision = loop.state.memory.revision;
  EXPECT_FALSE(loop.order(MissionOrder::kLease).memory_changed);
  EXPECT_FALSE(loop.run(1.0).memory_changed);
  EXPECT_EQ(loop.state.memory.revision, revision);
  EXPECT_TRUE(loop.order(MissionOrder::kRelease).memory_changed);
}

/// Nothing is written until it is said so.
struct Unwritten : FlightLoop {
  Unwritten() {
    take_off_and_track();
    extra.writing.written_revision = state.memory.revision;
  }
  void write() { extra.writing.written_revision = state.memory.revision; }
  void fail() { extra.writing.failed_revision = state.memory.revision; }
};

TEST(Memory, AnOrderActsAtOnceAndIsConfirmedWhenItIsWritten) {
  Unwritten loop;
  loop.order(MissionOrder::kHold);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.result.command_result, MissionResult::kPending);
  EXPECT_EQ(loop.run(1.0).command_result, MissionResult::kPending);
  loop.write();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAccepted);
}

TEST(Memory, AFailedWriteNeverRefusesStopHoldReturnOrLand) {
  for (const auto order :
       {MissionOrder::kStop, MissionOrder::kHold, MissionOrder::kReturn, MissionOrder::kLand}) {
    Unwritten loop;
    loop.order(order);
    const auto phase = loop.result.phase;
    loop.fail();
    EXPECT_EQ(loop.tick().command_result, MissionResult::kAcceptedUnwritten);
    EXPECT_EQ(loop.result.phase, phase);
  }
}

TEST(Memory, AFailedWriteUndoesAStart) {
  FlightLoop loop;
  loop.extra.writing.written_revision = 0;
  loop.order(MissionOrder::kStart);
  EXPECT_EQ(loop.result.command_result, MissionResult::kPending);
  loop.extra.writing.failed_revision = loop.state.memory.revision;
  loop.run_with_plans(5.0);
  EXPECT_EQ(loop.result.command_result, MissionResult::kRefusedUnwritten);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kUnwritten);
  EXPECT_EQ(loop.autopilot.total(), 0);
}

TEST(Memory, AFailedWriteUndoesAResumeToAHold) {
  Unwritten loop;
  loop.order(MissionOrder::kHold);
  loop.write();
  loop.order(MissionOrder::kResume);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  loop.fail();
  loop.tick();
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.result.command_result, MissionResult::kRefusedUnwritten);
}

TEST(Memory, AFailedWriteOfAStartDoesNotUndoTheStopThatCameAfterIt) {
  Unwritten loop;
  loop.order(MissionOrder::kHold);
  loop.write();
  loop.order(MissionOrder::kResume);
  loop.state.mission.phase = MissionPhase::kStopped;  // by whatever
  loop.fail();
  loop.tick();
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
}

TEST(Memory, AFailedWriteUndoesALeaseAndBounds) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_FALSE(loop.state.mission.lease.is_held(loop.now_s));
  MissionCommand bounds{
      .id = ++loop.last_order, .stamp_s = loop.stamp_now_s(), .order = MissionOrder::kSetBounds};
  bounds.bounds.altitude_max_m = 12.0;
  loop.tick(nullptr, &bounds);
  EXPECT_EQ(loop.state.mission.bounds.altitude_max_m, 12.0);
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_EQ(loop.state.mission.bounds, FlightBounds{});
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

}  // namespace
}  // namespace foretrack::testing
