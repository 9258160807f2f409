// SPDX-License-Identifier: Apache-2.0
// The steps of each phase; takeover_test.cpp has them within the whole gate.
#include "core/safety/carry_out.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using Request = AutopilotRequest;

// A gate's phase, and a flight controller that does what a test says.
struct Mate {
  CarryOut state;
  Mission mission;
  CarryOutInput in;
  CarryOutParams params;

  Mate(MissionPhase phase, FlightMode mode, bool armed = true) {
    in.now_s = 10.0;
    in.status.stamp_s = 10.0;
    in.ready = true;
    in.heartbeat_since_s = 0.0;
    set(mode, armed);
    mission.phase = phase;
    begin_phase(state, in.now_s, in.status);
  }
  void set(FlightMode mode, bool armed = true) {
    in.status.mode = mode;
    in.status.armed = armed;
    in.status.offboard = armed && mode == FlightMode::kOffboard;
  }
  Request tick(double dt_s = 0.02) {
    in.now_s += dt_s;
    return carry_out(state, mission, in, params);
  }
};

TEST(CarryOut, AStartArmsThenAsksForOffboardThenTracks) {
  Mate mate(MissionPhase::kStarting, FlightMode::kHold, false);
  EXPECT_EQ(mate.tick(), Request::kArm);
  EXPECT_EQ(mate.tick(), Request::kNone) << "it is asked once";
  mate.set(FlightMode::kHold);
  EXPECT_EQ(mate.tick(), Request::kOffboard);
  mate.set(FlightMode::kOffboard);
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_EQ(mate.mission.phase, MissionPhase::kTracking);
  EXPECT_TRUE(mate.mission.engaged);
}

TEST(CarryOut, AStartWaitsForAHeartbeatAndForAPlanAndGivesUp) {
  Mate mate(MissionPhase::kStarting, FlightMode::kHold);
  mate.in.heartbeat_since_s = 10.0;
  EXPECT_EQ(mate.tick(mate.params.heartbeat_before_s - 0.1), Request::kNone);
  EXPECT_EQ(mate.tick(0.2), Request::kOffboard);
  Mate waits(MissionPhase::kStarting, FlightMode::kHold);
  waits.in.ready = false;
  EXPECT_EQ(waits.tick(waits.params.patience_s - 0.1), Request::kNone);
  EXPECT_EQ(waits.mission.phase, MissionPhase::kStarting);
  waits.tick(0.2);
  EXPECT_EQ(waits.mission.phase, MissionPhase::kIdle);
  EXPECT_EQ(waits.state.end, MissionEnd::kNotReady);
}

TEST(CarryOut, WhoDisarmsAVehicleThatWeArmedEndsTheStart) {
  Mate mate(MissionPhase::kStarting, FlightMode::kHold, false);
  ASSERT_EQ(mate.tick(), Request::kArm);
  mate.set(FlightMode::kHold);
  ASSERT_EQ(mate.tick(), Request::kOffboard);
  mate.set(FlightMode::kHold, false);
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_EQ(mate.state.end, MissionEnd::kDisarmed);
}

TEST(CarryOut, OffboardThatIsLeftWhileTrackingIsNeverAskedForAgain) {
  Mate mate(MissionPhase::kTracking, FlightMode::kOffboard);
  EXPECT_EQ(mate.tick(), Request::kNone);
  mate.set(FlightMode::kHold);
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_EQ(mate.mission.phase, MissionPhase::kIdle);
  EXPECT_EQ(mate.state.end, MissionEnd::kOtherMode);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(mate.tick(), Request::kNone);
}

TEST(CarryOut, AReturnIsAskedOnceThenLeftToTheFlightControllerUntilItHasLanded) {
  Mate mate(MissionPhase::kReturning, FlightMode::kOffboard);
  mate.mission.engaged = true;
  EXPECT_EQ(mate.tick(), Request::kReturn);
  mate.set(FlightMode::kReturn);
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_TRUE(mate.state.delegated);
  EXPECT_FALSE(mate.mission.engaged);
  mate.set(FlightMode::kLand);
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_EQ(mate.mission.phase, MissionPhase::kReturning);
  mate.set(FlightMode::kLand, false);
  mate.tick();
  EXPECT_EQ(mate.mission.phase, MissionPhase::kIdle);
  EXPECT_EQ(mate.state.end, MissionEnd::kDone);
}

TEST(CarryOut, ARefusedReturnHoldsWhatIsStillOurs) {
  Mate mate(MissionPhase::kReturning, FlightMode::kOffboard);
  mate.mission.engaged = true;
  ASSERT_EQ(mate.tick(), Request::kReturn);
  const AutopilotAck denied{Request::kReturn, CommandResult::kDenied};
  mate.in.ack = &denied;
  EXPECT_EQ(mate.tick(), Request::kNone);
  EXPECT_EQ(mate.mission.phase, MissionPhase::kHolding);
  EXPECT_TRUE(mate.mission.engaged);
  EXPECT_EQ(mate.state.answer, CommandResult::kDenied);
  EXPECT_EQ(mate.state.end, MissionEnd::kRefused);
}

TEST(CarryOut, AStopLeavesWhatTheFlightControllerDoesAtOurRequestAndNoPilot) {
  Mate mate(MissionPhase::kLanding, FlightMode::kOffboard);
  ASSERT_EQ(mate.tick(), Request::kLand);
  mate.set(FlightMode::kLand);
  mate.tick();
  mate.mission.phase = MissionPhase::kStopped;
  begin_phase(mate.state, mate.in.now_s, mate.in.status);
  EXPECT_EQ(mate.tick(), Request::kHold);
  EXPECT_EQ(mate.tick(), Request::kNone);

  Mate pilots(MissionPhase::kStopped, FlightMode::kPilot);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pilots.tick(), Request::kNone);
}

TEST(CarryOut, EndingLeavesAStoppedVehicleStopped) {
  CarryOut state;
  Mission mission;
  mission.phase = MissionPhase::kStopped;
  mission.engaged = true;
  end_mission(state, mission, MissionEnd::kPilot);
  EXPECT_EQ(mission.phase, MissionPhase::kStopped);
  EXPECT_FALSE(mission.engaged);
  EXPECT_EQ(state.end, MissionEnd::kPilot);
  mission.phase = MissionPhase::kTracking;
  hold_mission(state, mission, MissionEnd::kFence);
  EXPECT_EQ(mission.phase, MissionPhase::kIdle) << "nothing is ours to hold";
}

// The place to return to, beside whatever the phase asks.
struct HomeMate : Mate {
  using Mate::Mate;
  HomeAsking home{{3.0, 4.0}, true};

  Request ask(double dt_s = 0.02) {
    in.now_s += dt_s;
    const Request request = ask_for_home(home, state, in, params);
    in.ack = nullptr;
    return request;
  }
  CommandResult answered(AutopilotAck ack) {
    in.ack = &ack;
    EXPECT_EQ(ask(), Request::kNone);
    return state.answer;
  }
};

TEST(CarryOut, AnotherHomeIsAskedForOnceAndItsAnswerIsTold) {
  HomeMate mate(MissionPhase::kTracking, FlightMode::kOffboard);
  EXPECT_EQ(mate.ask(), Request::kHome);
  EXPECT_EQ(mate.state.asked, Request::kHome);
  EXPECT_EQ(mate.state.answer, CommandResult::kInProgress);
  EXPECT_EQ(mate.ask(), Request::kNone) << "it is asked once";
  EXPECT_EQ(mate.answered({Request::kArm, CommandResult::kDenied}), CommandResult::kInProgress)
      << "the answer to something else";
  EXPECT_EQ(mate.answered({Request::kHome, CommandResult::kDenied}), CommandResult::kDenied);
  EXPECT_EQ(mate.ask(mate.params.ask.answer_s + 1.0), Request::kNone);
  EXPECT_EQ(mate.state.answer, CommandResult::kDenied);
  EXPECT_EQ(mate.mission.phase, MissionPhase::kTracking);
}

TEST(CarryOut, AnotherHomeThatIsNotAnsweredFailed) {
  HomeMate mate(MissionPhase::kIdle, FlightMode::kHold, false);
  ASSERT_EQ(mate.ask(), Request::kHome);
  EXPECT_EQ(mate.ask(mate.params.ask.answer_s - 0.1), Request::kNone);
  EXPECT_EQ(mate.state.answer, CommandResult::kInProgress);
  mate.ask(0.2);
  EXPECT_EQ(mate.state.answer, CommandResult::kFailed);
}

TEST(CarryOut, AnotherHomeWaitsUntilThePhaseIsAnswered) {
  HomeMate mate(MissionPhase::kStarting, FlightMode::kHold, false);
  ASSERT_EQ(mate.tick(), Request::kArm);
  EXPECT_EQ(mate.ask(), Request::kNone);
  mate.set(FlightMode::kHold);
  ASSERT_EQ(mate.tick(), Request::kOffboard);
  mate.set(FlightMode::kOffboard);
  mate.tick();
  EXPECT_EQ(mate.ask(), Request::kHome);
}

}  // namespace
}  // namespace foretrack
