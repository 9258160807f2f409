// SPDX-License-Identifier: Apache-2.0
#include "core/safety/autopilot_watch.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using Request = AutopilotRequest;

const AskParams kPatience;

AutopilotStatus flying(FlightMode mode) {
  AutopilotStatus status;
  status.stamp_s = 1.0;
  status.armed = true;
  status.offboard = mode == FlightMode::kOffboard;
  status.mode = mode;
  return status;
}

Asking asked_at(double now_s, Request request = Request::kOffboard) {
  return {request, now_s, false};
}

TEST(FollowRequest, IsDoneAsSoonAsTheStatusShowsItWhateverWasAnswered) {
  Asking asking = asked_at(1.0);
  const AutopilotAck denied{Request::kOffboard, CommandResult::kDenied};
  const AskProgress progress =
      follow(asking, &denied, flying(FlightMode::kOffboard), 1.1, kPatience);
  EXPECT_EQ(progress.state, AskState::kDone);
  EXPECT_EQ(asking.request, Request::kNone) << "it is never repeated";
}

TEST(FollowRequest, ARefusalEndsItAtOnceAndSomebodyElsesAnswerDoesNot) {
  Asking asking = asked_at(1.0);
  const AutopilotAck foreign{Request::kArm, CommandResult::kDenied};
  EXPECT_EQ(follow(asking, &foreign, flying(FlightMode::kHold), 1.1, kPatience).state,
            AskState::kWaits);
  const AutopilotAck denied{Request::kOffboard, CommandResult::kTemporarilyRejected};
  const AskProgress progress = follow(asking, &denied, flying(FlightMode::kHold), 1.2, kPatience);
  EXPECT_EQ(progress.state, AskState::kFailed);
  EXPECT_EQ(progress.why, MissionEnd::kRefused);
}

TEST(FollowRequest, NoAnswerIsWaitedForLessLongThanADeedThatWasAccepted) {
  const AutopilotStatus status = flying(FlightMode::kHold);
  Asking silent = asked_at(1.0), accepted = asked_at(1.0);
  const AutopilotAck yes{Request::kOffboard, CommandResult::kAccepted};
  EXPECT_EQ(follow(accepted, &yes, status, 1.1, kPatience).state, AskState::kWaits);
  const double after_s = 1.0 + kPatience.answer_s + 0.01;
  const AskProgress none = follow(silent, nullptr, status, after_s, kPatience);
  EXPECT_EQ(none.state, AskState::kFailed);
  EXPECT_EQ(none.why, MissionEnd::kNoAnswer);
  EXPECT_EQ(follow(accepted, nullptr, status, after_s, kPatience).state, AskState::kWaits);
  const AskProgress late =
      follow(accepted, nullptr, status, 1.0 + kPatience.done_s + 0.01, kPatience);
  EXPECT_EQ(late.state, AskState::kFailed);
  EXPECT_EQ(late.why, MissionEnd::kNotDone);
}

TEST(FollowRequest, NothingThatWasAskedIsNothing) {
  Asking asking;
  EXPECT_EQ(follow(asking, nullptr, flying(FlightMode::kHold), 99.0, kPatience).state,
            AskState::kNothing);
}

TEST(Shows, ALandingThatIsOverIsDoneAndAModeThatIsNotNamedIsAtLeastNotOffboard) {
  AutopilotStatus landed = flying(FlightMode::kHold);
  EXPECT_FALSE(shows(Request::kLand, landed));
  landed.armed = false;
  EXPECT_TRUE(shows(Request::kLand, landed));
  EXPECT_TRUE(shows(Request::kReturn, flying(FlightMode::kLand))) << "it ends with a landing";
  EXPECT_FALSE(shows(Request::kHold, flying(FlightMode::kOffboard)));
  AutopilotStatus unnamed = flying(FlightMode::kUnknown);
  EXPECT_TRUE(shows(Request::kReturn, unnamed));
  unnamed.offboard = true;
  EXPECT_FALSE(shows(Request::kReturn, unnamed));
}

TEST(TakenOver, TheWorstReasonIsTold) {
  AutopilotStatus status = flying(FlightMode::kOffboard);
  EXPECT_EQ(taken_over(status), MissionEnd::kNone);
  status.offboard = false;
  status.mode = FlightMode::kHold;
  EXPECT_EQ(taken_over(status), MissionEnd::kOtherMode);
  status.armed = false;
  EXPECT_EQ(taken_over(status), MissionEnd::kDisarmed);
  status.sticks_moved = true;
  EXPECT_EQ(taken_over(status), MissionEnd::kSticks);
  status.mode = FlightMode::kPilot;
  EXPECT_EQ(taken_over(status), MissionEnd::kPilot);
  status.failsafe = true;
  EXPECT_EQ(taken_over(status), MissionEnd::kFailsafe);
  status.mode = FlightMode::kTermination;
  EXPECT_EQ(taken_over(status), MissionEnd::kTerminated);
}

TEST(StartHindrance, AVehicleThatAPilotLeftAloneMayBeAskedForAndNoOther) {
  AutopilotStatus status = flying(FlightMode::kPilot);
  EXPECT_EQ(start_hindrance(status, FlightMode::kPilot), MissionEnd::kNone);
  EXPECT_EQ(start_hindrance(status, FlightMode::kHold), MissionEnd::kPilot) << "taken since";
  status.sticks_moved = true;
  EXPECT_EQ(start_hindrance(status, FlightMode::kPilot), MissionEnd::kSticks);
  status.sticks_moved = false;
  status.user_took_over = true;
  EXPECT_EQ(start_hindrance(status, FlightMode::kPilot), MissionEnd::kPilot);
  status = flying(FlightMode::kHold);
  status.failsafe = true;
  EXPECT_EQ(start_hindrance(status, FlightMode::kHold), MissionEnd::kFailsafe);
}

TEST(DelegatedEnd, EachPhaseMayLeadOnToItsOwnModes) {
  using Phase = MissionPhase;
  EXPECT_EQ(delegated_end(Phase::kReturning, flying(FlightMode::kLand)), MissionEnd::kNone);
  EXPECT_EQ(delegated_end(Phase::kLanding, flying(FlightMode::kReturn)), MissionEnd::kOtherMode);
  EXPECT_EQ(delegated_end(Phase::kTakingOff, flying(FlightMode::kHold)), MissionEnd::kDone);
  EXPECT_EQ(delegated_end(Phase::kTakingOff, flying(FlightMode::kTakeOff)), MissionEnd::kNone);
  EXPECT_EQ(delegated_end(Phase::kLanding, flying(FlightMode::kUnknown)), MissionEnd::kNone);
  AutopilotStatus landed = flying(FlightMode::kLand);
  landed.armed = false;
  EXPECT_EQ(delegated_end(Phase::kLanding, landed), MissionEnd::kDone);
  EXPECT_EQ(delegated_end(Phase::kLanding, flying(FlightMode::kPilot)), MissionEnd::kPilot);
}

TEST(AutopilotWords, EachHasItsOwn) {
  EXPECT_EQ(to_string(Request::kHold), "hold");
  EXPECT_EQ(to_string(MissionEnd::kLink), "no word from the operator");
  EXPECT_NE(to_string(CommandResult::kCancelled), to_string(CommandResult::kAccepted));
}

}  // namespace
}  // namespace foretrack
