// SPDX-License-Identifier: Apache-2.0
// Whose vehicle it is: what is asked of the flight controller, and who takes it back.
#include <gtest/gtest.h>

#include <functional>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

using Request = AutopilotRequest;

struct OnTheGround : FlightLoop {
  OnTheGround() { autopilot.status.armed = false; }
};

TEST(Takeover, AParkedVehicleIsNeverAskedForAnythingWithoutAnOrder) {
  OnTheGround loop;
  loop.run_with_plans(60.0);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_FALSE(loop.result.heartbeat);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
}

TEST(Takeover, AStartAsksOnceToArmAndOnceForOffboardWhenAPlanIsThere) {
  OnTheGround loop;
  loop.order(MissionOrder::kStart);
  loop.run(5.0);
  EXPECT_EQ(loop.autopilot.total(), 0) << "no plan";
  EXPECT_EQ(loop.result.phase, MissionPhase::kStarting);
  loop.run_with_plans(2.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  EXPECT_EQ(loop.autopilot.count(Request::kArm), 1);
  EXPECT_EQ(loop.autopilot.count(Request::kOffboard), 1);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.autopilot.total(), 2);
}

TEST(Takeover, OffboardIsAskedForAfterAnUnbrokenHeartbeat) {
  FlightLoop loop;
  loop.order(MissionOrder::kStart);
  while (loop.now_s < 1.15) loop.run_with_plans(kTick_s);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_TRUE(loop.result.heartbeat);
  EXPECT_FALSE(loop.result.setpoint);
  EXPECT_EQ(loop.result.reason, SafetyReason::kNotOffboard);
  loop.run_with_plans(0.2);
  EXPECT_EQ(loop.autopilot.count(Request::kOffboard), 1);
}

TEST(Takeover, AStartGivesUpWithWordsWhenNoPlanComes) {
  FlightLoop loop;
  loop.order(MissionOrder::kStart);
  loop.run(loop.params.start_patience_s + 1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kNotReady);
  EXPECT_EQ(loop.autopilot.total(), 0);
}

struct Answer {
  const char* name;
  std::optional<CommandResult> answer;
  MissionEnd end;
};
class Refusal : public ::testing::TestWithParam<Answer> {};

TEST_P(Refusal, OfARequestEndsTheStartAndIsNotAskedAgain) {
  for (const bool armed : {true, false}) {
    FlightLoop loop;
    loop.autopilot.status.armed = armed;
    loop.autopilot.answer = GetParam().answer;
    loop.autopilot.deaf = true;
    loop.order(MissionOrder::kStart);
    loop.run_with_plans(20.0);
    EXPECT_EQ(loop.autopilot.total(), 1);
    EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
    EXPECT_EQ(loop.result.end, GetParam().end);
    EXPECT_EQ(loop.result.asked, armed ? Request::kOffboard : Request::kArm);
    EXPECT_FALSE(loop.result.heartbeat);
    EXPECT_EQ(loop.result.answer, GetParam().answer.value_or(CommandResult::kInProgress));
    loop.order(MissionOrder::kStart);
    loop.run_with_plans(20.0);
    EXPECT_EQ(loop.autopilot.total(), 2) << "a new order asks again";
  }
}
INSTANTIATE_TEST_SUITE_P(
    Each, Refusal,
    ::testing::Values(Answer{"Denied", CommandResult::kDenied, MissionEnd::kRefused},
                      Answer{"TemporarilyRejected", CommandResult::kTemporarilyRejected,
                             MissionEnd::kRefused},
                      Answer{"Unsupported", CommandResult::kUnsupported, MissionEnd::kRefused},
                      Answer{"Failed", CommandResult::kFailed, MissionEnd::kRefused},
                      Answer{"Cancelled", CommandResult::kCancelled, MissionEnd::kRefused},
                      Answer{"Missing", std::nullopt, MissionEnd::kNoAnswer},
                      Answer{"InProgressForEver", CommandResult::kInProgress, MissionEnd::kNotDone},
                      Answer{"AcceptedButNotDone", CommandResult::kAccepted, MissionEnd::kNotDone}),
    [](const auto& each) { return each.param.name; });

TEST(Takeover, AnAnswerToSomethingElseIsNoAnswer) {
  FlightLoop loop;
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kStart);
  while (loop.autopilot.total() == 0) loop.run_with_plans(kTick_s);
  loop.autopilot.ack = AutopilotAck{Request::kLand, CommandResult::kDenied};
  loop.run_with_plans(0.5);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStarting);
  loop.run_with_plans(2.0);
  EXPECT_EQ(loop.result.end, MissionEnd::kNoAnswer);
}

struct Objection {
  const char* name;
  std::function<void(AutopilotStatus&)> happens;
  MissionEnd end;
};
AutopilotStatus& enter(AutopilotStatus& s, FlightMode mode) {
  s.mode = mode;
  s.offboard = mode == FlightMode::kOffboard;
  return s;
}
std::vector<Objection> objections() {
  return {
      {"PilotsMode", [](auto& s) { enter(s, FlightMode::kPilot); }, MissionEnd::kPilot},
      {"Sticks", [](auto& s) { s.sticks_moved = true; }, MissionEnd::kSticks},
      {"UserTookOver", [](auto& s) { s.user_took_over = true; }, MissionEnd::kPilot},
      {"Hold", [](auto& s) { enter(s, FlightMode::kHold); }, MissionEnd::kOtherMode},
      {"Land", [](auto& s) { enter(s, FlightMode::kLand); }, MissionEnd::kOtherMode},
      {"Return", [](auto& s) { enter(s, FlightMode::kReturn); }, MissionEnd::kOtherMode},
      {"OtherMode", [](auto& s) { enter(s, FlightMode::kOther); }, MissionEnd::kOtherMode},
      {"Disarm", [](auto& s) { s.armed = false; }, MissionEnd::kDisarmed},
      {"Failsafe", [](auto& s) { enter(s, FlightMode::kReturn).failsafe = true; },
       MissionEnd::kFailsafe},
      {"FailsafeInOffboard", [](auto& s) { s.failsafe = true; }, MissionEnd::kFailsafe},
      {"Termination", [](auto& s) { enter(s, FlightMode::kTermination).failsafe = true; },
       MissionEnd::kTerminated},
  };
}
class Takes : public ::testing::TestWithParam<Objection> {};

TEST_P(Takes, TheVehicleFromATrackingMissionForGood) {
  FlightLoop loop;
  loop.take_off_and_track();
  const int asked = loop.autopilot.total();
  GetParam().happens(loop.autopilot.status);
  loop.run_with_plans(kTick_s);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, GetParam().end);
  EXPECT_FALSE(loop.result.heartbeat);
  EXPECT_FALSE(loop.result.setpoint);
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.autopilot.total(), asked);
  EXPECT_FALSE(loop.result.heartbeat);
}

TEST_P(Takes, TheVehicleFromAHoldingMissionForGood) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kHold);
  const int asked = loop.autopilot.total();
  GetParam().happens(loop.autopilot.status);
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, GetParam().end);
  EXPECT_EQ(loop.autopilot.total(), asked);
  EXPECT_FALSE(loop.result.heartbeat);
}

TEST_P(Takes, TheVehicleFromAStoppedMissionWhichStaysStopped) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kStop);
  const int asked = loop.autopilot.total();
  GetParam().happens(loop.autopilot.status);
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(loop.autopilot.total(), asked);
  EXPECT_FALSE(loop.result.heartbeat);
}
INSTANTIATE_TEST_SUITE_P(Each, Takes, ::testing::ValuesIn(objections()),
                         [](const auto& each) { return each.param.name; });

TEST(Takeover, ANewStartAsksAgainAfterThePilotHadIt) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.enter(FlightMode::kPilot);
  loop.run_with_plans(5.0);
  ASSERT_EQ(loop.autopilot.count(Request::kOffboard), 1);
  loop.take_off_and_track();
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  EXPECT_EQ(loop.autopilot.count(Request::kOffboard), 2);
}

TEST(Takeover, EndsAStartThatIsUnderWay) {
  for (const auto& objection : objections()) {
    FlightLoop loop;
    loop.order(MissionOrder::kStart);
    loop.run_with_plans(0.5);
    objection.happens(loop.autopilot.status);
    const bool forbids =
        objection.end != MissionEnd::kOtherMode && objection.end != MissionEnd::kDisarmed;
    loop.run_with_plans(0.1);
    EXPECT_EQ(loop.result.phase, forbids ? MissionPhase::kIdle : MissionPhase::kStarting)
        << objection.name;
    EXPECT_EQ(loop.autopilot.total(), 0) << objection.name;
  }
}

TEST(Takeover, AStartFromAPilotsModeIsGrantedUnlessTheSticksMove) {
  FlightLoop loop;
  loop.autopilot.enter(FlightMode::kPilot);
  loop.take_off_and_track();
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  FlightLoop moved;
  moved.autopilot.enter(FlightMode::kPilot);
  moved.order(MissionOrder::kStart);
  moved.autopilot.status.sticks_moved = true;
  moved.run_with_plans(5.0);
  EXPECT_EQ(moved.result.end, MissionEnd::kSticks);
  EXPECT_EQ(moved.autopilot.total(), 0);
}

TEST(Takeover, AVehicleThatDisarmsAgainDuringAStartIsNotArmedAgain) {
  OnTheGround loop;
  loop.order(MissionOrder::kStart);
  while (loop.autopilot.count(Request::kArm) == 0) loop.run_with_plans(kTick_s);
  loop.autopilot.deaf = true;
  loop.autopilot.answer = CommandResult::kInProgress;
  loop.run_with_plans(0.1);
  ASSERT_EQ(loop.autopilot.count(Request::kOffboard), 1);
  loop.autopilot.status.armed = false;
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.end, MissionEnd::kDisarmed);
  EXPECT_EQ(loop.autopilot.count(Request::kArm), 1);
}

TEST(Takeover, AVehicleThatLeavesOffboardDuringAStartIsNotAskedForAgain) {
  FlightLoop loop;
  loop.order(MissionOrder::kStart);
  while (loop.autopilot.total() == 0) loop.run_with_plans(kTick_s);
  loop.autopilot.enter(FlightMode::kOffboard);
  loop.autopilot.status.armed = false;  // so that it is not yet ours
  loop.run_with_plans(kTick_s);
  loop.autopilot.enter(FlightMode::kHold);
  loop.autopilot.status.armed = true;
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.autopilot.total(), 1);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
}

TEST(Takeover, StopOnTheGroundDoesNothingButStop) {
  OnTheGround loop;
  loop.order(MissionOrder::kStop);
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.autopilot.total(), 0);
  EXPECT_FALSE(loop.result.heartbeat);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
}

TEST(Takeover, StopDoesNotTakeTheVehicleFromAPilotOrAFailsafe) {
  for (const auto& objection : objections()) {
    FlightLoop loop;
    loop.take_off_and_track();
    const int asked = loop.autopilot.total();
    objection.happens(loop.autopilot.status);
    loop.run_with_plans(0.1);
    loop.order(MissionOrder::kStop);
    loop.run_with_plans(10.0);
    EXPECT_EQ(loop.autopilot.total(), asked) << objection.name;
  }
}

struct Delegated {
  const char* name;
  MissionOrder order;
  Request request;
  MissionPhase phase;
  FlightMode mode;
};
class Delegation : public ::testing::TestWithParam<Delegated> {};

TEST_P(Delegation, IsAskedForOnceAndLeftToTheFlightController) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.asked = {};
  const auto r = loop.order(GetParam().order);
  EXPECT_EQ(r.request, GetParam().request);
  EXPECT_TRUE(r.heartbeat) << "until the flight controller has it";
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.result.phase, GetParam().phase);
  EXPECT_FALSE(loop.result.heartbeat);
  EXPECT_EQ(loop.autopilot.total(), 1);
  loop.autopilot.status.armed = false;  // on the ground
  loop.run_with_plans(30.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kDone);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST_P(Delegation, ThatIsRefusedHoldsThePlaceAndSaysWhy) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.asked = {};
  loop.autopilot.answer = CommandResult::kDenied;
  loop.order(GetParam().order);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_EQ(loop.result.end, MissionEnd::kRefused);
  EXPECT_EQ(loop.result.answer, CommandResult::kDenied);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST_P(Delegation, IsOverWhenSomebodyChoosesAnotherMode) {
  for (const auto mode : {FlightMode::kPilot, FlightMode::kHold, FlightMode::kOther}) {
    FlightLoop loop;
    loop.take_off_and_track();
    loop.order(GetParam().order);
    loop.run_with_plans(1.0);
    loop.autopilot.asked = {};
    loop.autopilot.enter(mode);
    loop.run_with_plans(10.0);
    EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
    EXPECT_EQ(loop.result.end,
              mode == FlightMode::kPilot ? MissionEnd::kPilot : MissionEnd::kOtherMode);
    EXPECT_EQ(loop.autopilot.total(), 0);
  }
}

TEST_P(Delegation, IsEndedByAPilotBeforeTheFlightControllerAnswers) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.asked = {};
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;
  loop.order(GetParam().order);
  loop.autopilot.enter(FlightMode::kPilot);
  loop.run_with_plans(kTick_s);
  EXPECT_EQ(loop.result.end, MissionEnd::kPilot);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_FALSE(loop.result.heartbeat);
}

TEST_P(Delegation, IsLeftOnceForAStopAndHeldByTheFlightController) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(GetParam().order);
  loop.run_with_plans(1.0);
  loop.autopilot.asked = {};
  loop.order(MissionOrder::kStop);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(loop.autopilot.count(Request::kHold), 1);
  EXPECT_EQ(loop.autopilot.total(), 1);
  EXPECT_EQ(loop.autopilot.status.mode, FlightMode::kHold);
}

TEST_P(Delegation, ThatBeginsAfterTheStopIsLeftAsWell) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.deaf = true;
  loop.order(GetParam().order);
  loop.order(MissionOrder::kStop);
  loop.autopilot.deaf = false;
  loop.autopilot.asked = {};
  loop.autopilot.enter(GetParam().mode);
  loop.run_with_plans(10.0);
  EXPECT_EQ(loop.autopilot.count(Request::kHold), 1);
  EXPECT_EQ(loop.autopilot.total(), 1);
}
INSTANTIATE_TEST_SUITE_P(Each, Delegation,
                         ::testing::Values(Delegated{"Return", MissionOrder::kReturn,
                                                     Request::kReturn, MissionPhase::kReturning,
                                                     FlightMode::kReturn},
                                           Delegated{"Land", MissionOrder::kLand, Request::kLand,
                                                     MissionPhase::kLanding, FlightMode::kLand}),
                         [](const auto& each) { return each.param.name; });

TEST(Takeover, AReturnThatLandsByItselfGoesOn) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kReturn);
  loop.run(1.0);
  loop.autopilot.enter(FlightMode::kLand);
  EXPECT_EQ(loop.run(10.0).phase, MissionPhase::kReturning);
}

TEST(Takeover, AnUnansweredLandingIsAskedForAgainByANewOrderAlone) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kLand);
  loop.run_with_plans(20.0);
  EXPECT_EQ(loop.autopilot.count(Request::kLand), 1);
  EXPECT_EQ(loop.result.end, MissionEnd::kNoAnswer);
  loop.order(MissionOrder::kLand);
  loop.run_with_plans(20.0);
  EXPECT_EQ(loop.autopilot.count(Request::kLand), 2);
}

TEST(Takeover, TakeOffArmsOnceAndLeavesTheRestToTheFlightController) {
  OnTheGround loop;
  loop.order(MissionOrder::kTakeOff);
  loop.run(5.0);
  EXPECT_EQ(loop.autopilot.count(Request::kArm), 1);
  EXPECT_EQ(loop.autopilot.count(Request::kTakeOff), 1);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTakingOff);
  EXPECT_FALSE(loop.result.heartbeat);
  loop.autopilot.enter(FlightMode::kHold);
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kDone);
  EXPECT_EQ(loop.autopilot.total(), 2);
}

// After a flight PX4 stays in offboard mode, in which it does not arm without a heartbeat.
TEST(Takeover, ATakeOffLeavesTheModeInWhichTheVehicleCannotArm) {
  OnTheGround loop;
  loop.autopilot.enter(FlightMode::kOffboard);
  loop.order(MissionOrder::kTakeOff);
  EXPECT_EQ(loop.autopilot.count(Request::kTakeOff), 1);
  EXPECT_EQ(loop.autopilot.count(Request::kArm), 0);
  loop.run(1.0);
  EXPECT_EQ(loop.autopilot.count(Request::kArm), 1);
  EXPECT_EQ(loop.autopilot.status.mode, FlightMode::kTakeOff);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTakingOff);
}

TEST(Takeover, ATakeOffThatIsNotArmedForOrDisarmsEnds) {
  OnTheGround denied;
  denied.autopilot.answer = CommandResult::kDenied;
  denied.order(MissionOrder::kTakeOff);
  EXPECT_EQ(denied.run(5.0).end, MissionEnd::kRefused);
  EXPECT_EQ(denied.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(denied.autopilot.total(), 1);
  OnTheGround disarms;
  disarms.order(MissionOrder::kTakeOff);
  disarms.tick();  // it has been asked to take off, and to arm
  disarms.autopilot.status.armed = false;
  disarms.state.carrying.asking = {};
  EXPECT_EQ(disarms.tick().end, MissionEnd::kDisarmed);
}

TEST(Takeover, AHoldDuringAReturnIsAskedOfTheFlightControllerAndLostToAPilot) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kReturn);
  loop.run(1.0);
  loop.autopilot.asked = {};
  loop.order(MissionOrder::kHold);
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kHolding);
  EXPECT_EQ(loop.autopilot.count(Request::kHold), 1);
  EXPECT_EQ(loop.autopilot.total(), 1);
  loop.autopilot.enter(FlightMode::kPilot);
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kPilot);
}

TEST(Takeover, AHoldThatTheFlightControllerDoesNotTakeIsSaid) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kReturn);
  loop.run(1.0);
  loop.autopilot.asked = {};
  loop.autopilot.answer = CommandResult::kDenied;
  loop.order(MissionOrder::kHold);
  loop.run(5.0);
  EXPECT_EQ(loop.result.end, MissionEnd::kRefused);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST(Takeover, ResumeUnderOffboardFliesOnAndElseAsksOnce) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kHold);
  EXPECT_EQ(loop.order(MissionOrder::kResume).phase, MissionPhase::kTracking);
  loop.order(MissionOrder::kReturn);
  loop.run(1.0);
  loop.order(MissionOrder::kHold);
  loop.run(1.0);
  loop.autopilot.asked = {};
  EXPECT_EQ(loop.order(MissionOrder::kResume).phase, MissionPhase::kStarting);
  loop.run_with_plans(3.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kTracking);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST(Takeover, OffboardThatComesAfterTheStopBrakesAndHolds) {
  FlightLoop loop;
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kStart);
  while (loop.autopilot.total() == 0) loop.run_with_plans(kTick_s);
  loop.order(MissionOrder::kStop);
  loop.autopilot.enter(FlightMode::kOffboard);
  loop.run_with_plans(1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_TRUE(loop.result.heartbeat);
  EXPECT_EQ(loop.autopilot.total(), 1);
}

TEST(Takeover, AHoldThatLandsAllTheSameIsIdleOnTheGround) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.order(MissionOrder::kReturn);
  loop.run(1.0);
  loop.autopilot.answer = CommandResult::kDenied;
  loop.order(MissionOrder::kHold);
  loop.run(1.0);
  loop.autopilot.status.armed = false;
  EXPECT_EQ(loop.run(1.0).phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kDisarmed);
}

TEST(Takeover, AReturnThatLandsAtOnceIsLeftToTheFlightController) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kReturn);
  loop.autopilot.enter(FlightMode::kLand);
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kReturning);
  EXPECT_FALSE(loop.result.heartbeat);
}

TEST(Takeover, AVehicleThatDisarmsWhileItIsAskedToLandHasLanded) {
  FlightLoop loop;  // flown by the flight controller alone
  loop.autopilot.answer.reset();
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kLand);
  ASSERT_EQ(loop.autopilot.count(Request::kLand), 1);
  loop.autopilot.status.armed = false;
  loop.run(1.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kDone);
}

TEST(Takeover, AStartFromAPilotsModeEndsWhenThePilotTakesTheVehicle) {
  FlightLoop loop;
  loop.autopilot.enter(FlightMode::kPilot);
  loop.order(MissionOrder::kStart);
  loop.run_with_plans(0.5);
  ASSERT_EQ(loop.result.phase, MissionPhase::kStarting);
  loop.autopilot.status.user_took_over = true;
  loop.run_with_plans(5.0);
  EXPECT_EQ(loop.result.end, MissionEnd::kPilot);
  EXPECT_EQ(loop.autopilot.total(), 0);
}

TEST(Takeover, ATakeOffIsOverWhenSomebodyChoosesAnotherMode) {
  OnTheGround loop;
  loop.order(MissionOrder::kTakeOff);
  loop.run(5.0);
  ASSERT_EQ(loop.result.phase, MissionPhase::kTakingOff);
  loop.autopilot.enter(FlightMode::kOther);
  EXPECT_EQ(loop.run(1.0).phase, MissionPhase::kIdle);
  EXPECT_EQ(loop.result.end, MissionEnd::kOtherMode);
}

TEST(Takeover, AStopDuringATakeOffIsAskedOfTheFlightControllerOnce) {
  OnTheGround loop;
  loop.order(MissionOrder::kTakeOff);
  loop.run(5.0);
  loop.order(MissionOrder::kStop);
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(loop.autopilot.count(Request::kHold), 1);
}

// The status changes in the same tick in which the order to stop comes.
TEST(Takeover, AStopAsksForNothingOfWhoHoldsIsOnTheGroundOrActsInAFailsafe) {
  const std::function<void(AutopilotStatus&)> happen[] = {
      [](auto& s) { enter(s, FlightMode::kHold); }, [](auto& s) { s.armed = false; },
      [](auto& s) { s.failsafe = true; }};
  for (const auto& happens : happen) {
    FlightLoop loop;
    loop.take_off_and_track();
    loop.order(MissionOrder::kReturn);
    loop.run(1.0);
    loop.autopilot.asked = {};
    happens(loop.autopilot.status);
    loop.order(MissionOrder::kStop);
    loop.run(5.0);
    EXPECT_EQ(loop.result.phase, MissionPhase::kStopped);
    EXPECT_EQ(loop.autopilot.total(), 0);
  }
}

TEST(Takeover, WorksWithAFlightControllerThatDoesNotNameItsModes) {
  FlightLoop loop;
  loop.take_off_and_track();
  const auto leave = [&] {
    loop.autopilot.status.mode = FlightMode::kUnknown;
    loop.autopilot.status.offboard = false;
  };
  loop.autopilot.deaf = true;
  loop.order(MissionOrder::kLand);
  leave();
  loop.run(5.0);
  EXPECT_EQ(loop.result.phase, MissionPhase::kLanding);
  loop.order(MissionOrder::kStop);
  loop.run(5.0);
  EXPECT_EQ(loop.autopilot.count(Request::kHold), 1);
}

}  // namespace
}  // namespace foretrack::testing
