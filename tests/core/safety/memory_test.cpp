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
  ASSERT_EQ(loop.order_ceiling(12.0).command_result, MissionResult::kAccepted);
  const MissionCommand bounds = loop.state.order.last;
  kill_and_restart(loop);
  EXPECT_EQ(loop.state.mission.bounds.altitude_max_m, 12.0);
  EXPECT_EQ(loop.state.mission.lease.operator_name.view(), "ada");
  EXPECT_EQ(loop.tick(nullptr, &bounds).command_result, MissionResult::kRefusedRepeated);
  EXPECT_EQ(loop.order(MissionOrder::kStart, "bob").command_result, MissionResult::kRefusedForeign);
  EXPECT_EQ(loop.order(MissionOrder::kLease, "ada").command_result, MissionResult::kAccepted);
  loop.run(loop.params.lease_s + 0.1);
  EXPECT_EQ(loop.order(MissionOrder::kLease, "bob").command_result, MissionResult::kAccepted);
}

TEST(Memory, NothingIsResumedWhateverWasDoneBeforeTheKill) {
  using P = MissionPhase;
  constexpr std::pair<P, P> kRestarts[] = {{P::kIdle, P::kIdle},        {P::kTracking, P::kHolding},
                                           {P::kHolding, P::kHolding},  {P::kReturning, P::kIdle},
                                           {P::kLanding, P::kIdle},     {P::kStopped, P::kStopped},
                                           {P::kStarting, P::kHolding}, {P::kTakingOff, P::kIdle}};
  for (const auto& [before, after] : kRestarts) {
    GateMemory memory;
    memory.phase = before;
    EXPECT_EQ(mission_of(memory, 0.0, {}).phase, after) << to_string(before);
  }
}

TEST(Memory, TheSameLeaseUnderAnotherNameIsNews) {
  FlightLoop loop;
  loop.order(MissionOrder::kLease, "ada");
  MissionCommand renewal = loop.state.order.last;
  renewal.id = ++loop.last_order;
  renewal.stamp_s = loop.stamp_now_s();
  renewal.operator_name = "bea";
  EXPECT_TRUE(loop.tick(nullptr, &renewal).memory_changed);
  EXPECT_EQ(loop.state.memory.lease_operator.view(), "bea");
}

TEST(Memory, OfAnotherVersionOrDamagedIsAsNone) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kStop);
  const GateMemory good = loop.state.memory;
  ASSERT_EQ(mission_of(good, 0.0, {}).phase, MissionPhase::kStopped);
  GateMemory bad[5] = {good, good, good, good, good};
  bad[0].version = GateMemory::kVersion + 1;
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

TEST(Memory, AFailedWriteUndoesATakeOff) {
  FlightLoop loop;
  loop.autopilot.status.armed = false;
  loop.autopilot.answer = CommandResult::kInProgress;
  loop.autopilot.deaf = true;
  loop.extra.writing.written_revision = 0;
  loop.order(MissionOrder::kTakeOff);
  ASSERT_EQ(loop.result.phase, MissionPhase::kTakingOff);
  loop.extra.writing.failed_revision = loop.state.memory.revision;
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
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
  loop.order(MissionOrder::kLease, "ada");
  loop.write();
  loop.order_ceiling(12.0);
  EXPECT_EQ(loop.state.mission.bounds.altitude_max_m, 12.0);
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_EQ(loop.state.mission.bounds, FlightBounds{});
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
}

// A person to be followed, and a framing.
struct Settings : Unwritten {
  MovingBodies bodies;
  Settings() {
    bodies.add({.id = 7, .kind = BodyKind::kPerson});
    extra.bodies = &bodies;
    order(MissionOrder::kLease, "ada");
    write();
    tick();
  }
  GateResult set(MissionCommand command) {
    extra.bodies_at_s = now_s;
    command.id = ++last_order;
    command.stamp_s = stamp_now_s();
    command.operator_name = command.lease_id = "ada";
    command.proved = true;
    return tick(nullptr, &command);
  }
  GateResult follow() { return set({.order = MissionOrder::kFollow, .person_id = 7}); }
  GateResult frame(double distance_m) {
    return set({.order = MissionOrder::kSetFraming, .framing = {.distance_m = distance_m}});
  }
};

TEST(Memory, KeepsWhomToFollowAndTheFramingAcrossAKill) {
  Settings loop;
  loop.follow();
  loop.frame(4.0);
  loop.write();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAccepted);
  EXPECT_EQ(loop.result.person, (PersonChoice{true, 7}));
  EXPECT_EQ(loop.result.framing, Framing{.distance_m = 4.0});
  const Mission after = mission_of(loop.state.memory, 0.0, {});
  EXPECT_EQ(after.person, (PersonChoice{true, 7}));
  EXPECT_EQ(after.framing, Framing{.distance_m = 4.0});
  const MissionRules narrower{.framing = {.distance_max_m = 3.0}};
  EXPECT_TRUE(mission_of(loop.state.memory, 0.0, narrower).framing.is_free());
}

TEST(Memory, AFailedWriteUndoesWhomToFollowAndTheFraming) {
  Settings loop;
  EXPECT_EQ(loop.frame(4.0).command_result, MissionResult::kPending);
  loop.write();
  loop.tick();
  loop.follow();
  loop.set({.order = MissionOrder::kFollow});  // nobody
  loop.frame(5.0);
  loop.frame(6.0);
  EXPECT_EQ(loop.state.mission.person, (PersonChoice{true, 0}));
  loop.fail();
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten) << i;
  }
  EXPECT_EQ(loop.state.mission.person, PersonChoice{});
  EXPECT_EQ(loop.state.mission.framing, Framing{.distance_m = 4.0}) << "as it was written last";
}

// ── orders that come while another one is being written ──

TEST(Memory, ARefusedOrderIsAnsweredAndDoesNotHideTheOneThatIsBeingWritten) {
  for (const bool written : {true, false}) {
    Unwritten loop;
    loop.order(MissionOrder::kHold);
    loop.write();
    loop.tick();
    loop.order(MissionOrder::kResume);
    const auto resume = loop.last_order;
    EXPECT_EQ(loop.order(MissionOrder::kResume).command_result, MissionResult::kRefusedPhase);
    EXPECT_EQ(loop.result.command_id, resume + 1);
    written ? loop.write() : loop.fail();
    loop.tick();
    EXPECT_EQ(loop.result.command_id, resume) << "it is answered, too";
    EXPECT_EQ(loop.result.command_result,
              written ? MissionResult::kAccepted : MissionResult::kRefusedUnwritten);
    EXPECT_EQ(loop.result.phase, written ? MissionPhase::kTracking : MissionPhase::kHolding);
  }
}

TEST(Memory, AStrangersRefusedOrderDoesNotKeepALeaseThatCannotBeWritten) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  EXPECT_EQ(loop.order(MissionOrder::kHold, "bob").command_result, MissionResult::kRefusedForeign);
  loop.fail();
  loop.tick();
  EXPECT_FALSE(loop.state.mission.lease.is_held(loop.now_s));
}

TEST(Memory, AFailedWriteUndoesAllThatWaitedForItToWhatWasBefore) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.order_ceiling(12.0);
  loop.order_ceiling(14.0);
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_FALSE(loop.state.mission.lease.is_held(loop.now_s));
  EXPECT_EQ(loop.state.mission.bounds, FlightBounds{});
  loop.write();  // that it is undone
  loop.tick();
  EXPECT_EQ(mission_of(loop.state.memory, 0.0, {}).bounds, FlightBounds{});
}

TEST(Memory, AStopThatCameAfterAStartIsAcceptedAlthoughNeitherCanBeWritten) {
  Unwritten loop;
  loop.order(MissionOrder::kHold);
  loop.write();
  loop.tick();
  loop.order(MissionOrder::kResume);
  loop.order(MissionOrder::kStop);
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAcceptedUnwritten);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
}

TEST(Memory, ARepeatedStopIsConfirmedNoSoonerThanTheFirst) {
  Unwritten loop;
  loop.order(MissionOrder::kStop);
  EXPECT_EQ(loop.order(MissionOrder::kStop).command_result, MissionResult::kPending);
  loop.write();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAccepted);
  EXPECT_EQ(loop.order(MissionOrder::kStop).command_result, MissionResult::kAccepted)
      << "nothing of it is to be written";
}

TEST(Memory, EachOrderThatWaitedIsAnswered) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.write();
  loop.tick();
  loop.order(MissionOrder::kHold, "ada");
  const auto hold = loop.last_order;
  EXPECT_EQ(loop.order(MissionOrder::kLease, "ada").command_result, MissionResult::kPending);
  loop.write();
  EXPECT_EQ(loop.order(MissionOrder::kStart, "ada").command_result, MissionResult::kRefusedPhase)
      << "an answer does not take another one's place";
  EXPECT_EQ(loop.tick().command_id, hold);
  EXPECT_EQ(loop.result.command_result, MissionResult::kAccepted);
  EXPECT_EQ(loop.tick().command_id, hold + 1);
  EXPECT_EQ(loop.result.command_result, MissionResult::kAccepted);
  EXPECT_EQ(loop.tick().command_id, hold + 1);
}

TEST(Memory, OfManyOrdersThatWaitTheNewestAreAnswered) {
  Unwritten loop;
  for (int i = 0; i < 20; ++i) loop.order(MissionOrder::kStop);
  loop.write();
  for (int i = 0; i < UnwrittenOrders::kCapacity; ++i)
    EXPECT_EQ(loop.tick().command_result, MissionResult::kAccepted);
  EXPECT_EQ(loop.result.command_id, loop.last_order);
}

TEST(Memory, AReleaseStandsAlthoughItCannotBeWrittenAndTheLeaseAfterItIsUndoneToNone) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.write();
  loop.tick();
  loop.order(MissionOrder::kRelease, "ada");
  loop.order(MissionOrder::kLease, "bob");
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAcceptedUnwritten);
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_FALSE(loop.state.mission.lease.is_held(loop.now_s));
}

TEST(Memory, ALeaseThatIsTakenAnewBeforeItIsWrittenIsUndoneToWhatWasBefore) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.run(loop.params.lease_s + 0.1);  // the disk is slow
  loop.order(MissionOrder::kLease, "bob");
  loop.fail();
  loop.tick();
  EXPECT_TRUE(loop.state.mission.lease.id.empty());
}

TEST(Memory, AReleaseIsAcceptedAlthoughTheStartBeforeItIsUndone) {
  Unwritten loop;
  loop.order(MissionOrder::kLease, "ada");
  loop.order(MissionOrder::kHold, "ada");
  loop.write();
  loop.tick();
  loop.order(MissionOrder::kResume, "ada");
  loop.order(MissionOrder::kRelease, "ada");
  loop.fail();
  EXPECT_EQ(loop.tick().command_result, MissionResult::kRefusedUnwritten);
  EXPECT_EQ(loop.tick().command_result, MissionResult::kAcceptedUnwritten);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_FALSE(loop.state.mission.lease.is_held(loop.now_s));
}

}  // namespace
}  // namespace foretrack::testing
