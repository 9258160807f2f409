// SPDX-License-Identifier: Apache-2.0
#include "core/scores/truth.hpp"

#include <gtest/gtest.h>

#include "tests/core/scores/walks.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

std::optional<Intention> label(const Truth& truth, double time_s) {
  return label_at(truth, truth.steps(time_s));
}

// By so much to the left from 4 s on, at 180° a second.
Truth left_by(double degrees) {
  return walk(10.0, [=](double t) -> Vec2 {
    return 1.5 * direction_of(rad(std::clamp(180.0 * (t - 4.0), 0.0, degrees)));
  });
}

TEST(Truth, LabelsAreThoseOfWhatFollows) {
  const Truth turn = left_turn(10.0, 4.0), stop = sudden_stop(10.0, 4.0);
  EXPECT_EQ(label(turn, 2.5), Intention::kForward);
  EXPECT_EQ(label(turn, 3.5), Intention::kTurnLeft);
  EXPECT_EQ(label(turn, 6.0), Intention::kForward);
  EXPECT_EQ(label(stop, 3.5), Intention::kDecelerate);
  EXPECT_EQ(label(stop, 6.0), std::nullopt) << "who stands has none";
  EXPECT_EQ(label(turn, 8.5), std::nullopt) << "the future is not known";
}

TEST(Truth, AMotionThatReversesWithinTwoSecondsTurnsBack) {
  const Truth back = turn_back(10.0, 4.0);
  EXPECT_EQ(label(back, 2.3), Intention::kForward);
  EXPECT_EQ(label(back, 3.0), Intention::kTurnBack) << "and does not decelerate";
  EXPECT_EQ(label(back, 5.2), Intention::kForward) << "it is done";
}

TEST(Truth, MoreThan120DegreesGoBeforeLeftAndRight) {
  EXPECT_EQ(label(left_by(110.0), 3.5), Intention::kTurnLeft);
  EXPECT_EQ(label(left_by(130.0), 3.5), Intention::kTurnBack);
  EXPECT_EQ(label(left_by(130.0), 4.3), Intention::kTurnLeft) << "what is left of it is a turn";
}

TEST(Truth, WhoSlowsDownForACornerTurns) {
  const Truth corner = walk(10.0, [](double t) -> Vec2 {
    const double speed = t < 4.0 ? 1.5 : std::max(0.5, 1.5 - 3.0 * (t - 4.0));
    return speed * direction_of(rad(180.0) * std::clamp(t - 4.6, 0.0, 0.5));
  });
  EXPECT_EQ(label(corner, 3.5), Intention::kTurnLeft);
  const auto intended = intended_events_of(corner);
  ASSERT_EQ(intended.size(), 1u);
  EXPECT_EQ(intended[0].kind, Intention::kTurnLeft);
}

TEST(Truth, SetsOffFromStandingToWalkingWithinASecond) {
  const Truth start = walk(6.0, [](double t) { return Vec2(t < 3.0 ? 0.1 : 1.0, 0.0); });
  EXPECT_FALSE(sets_off(start, start.steps(1.5)));
  EXPECT_TRUE(sets_off(start, start.steps(2.5)));
  EXPECT_FALSE(sets_off(start, start.steps(4.0))) << "who walks does not set off";
}

TEST(Truth, FindsEachTurnAndStopOnceFromItsBeginningToItsEnd) {
  const auto turns = turns_of(left_turn(10.0, 4.0));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].kind, Intention::kTurnLeft);
  EXPECT_NEAR(turns[0].begin_s, 4.0, 0.021);
  EXPECT_NEAR(turns[0].end_s, 4.5, 0.021);
  EXPECT_NEAR(turns[0].turn_rad, kPi / 2.0, 0.05);
  EXPECT_TRUE(stops_of(left_turn(10.0, 4.0)).empty());
  const auto stops = stops_of(sudden_stop(10.0, 4.0));
  ASSERT_EQ(stops.size(), 1u);
  EXPECT_NEAR(stops[0].begin_s, 4.0, 0.021);
  EXPECT_NEAR(stops[0].end_s, 4.5, 0.021);
}

TEST(Truth, ShortPausesDoNotPartATurnAndGentleBendsAreNone) {
  const Truth paused = walk(10.0, [](double t) -> Vec2 {
    const double turned_s = std::clamp(t - 4.0, 0.0, 0.3) + std::clamp(t - 4.5, 0.0, 0.3);
    return 1.5 * direction_of(rad(120.0) * turned_s);
  });
  EXPECT_EQ(turns_of(paused).size(), 1u);
  const Truth gentle =
      walk(10.0, [](double t) -> Vec2 { return 1.5 * direction_of(rad(15.0) * t); });
  EXPECT_TRUE(turns_of(gentle).empty());
}

TEST(Truth, SlowingDownToTurnBackAndTurningAreOneEvent) {
  const auto events = intended_events_of(turn_back(10.0, 4.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Intention::kTurnBack);
  EXPECT_NEAR(events[0].begin_s, 4.0, 0.021);
}

TEST(Truth, ATurnToTheOtherSideHasTheOtherLabel) {
  const Truth right = walk(10.0, [](double t) -> Vec2 {
    return 1.5 * direction_of(-rad(180.0) * std::clamp(t - 4.0, 0.0, 0.5));
  });
  EXPECT_EQ(label(right, 3.5), Intention::kTurnRight);
  ASSERT_EQ(turns_of(right).size(), 1u);
  EXPECT_EQ(turns_of(right)[0].kind, Intention::kTurnRight);
}

TEST(Truth, ABendOfLessThanThirtyDegreesInASecondIsNoTurn) {
  const auto bend = [](double deg_s) {
    return walk(10.0, [=](double t) -> Vec2 { return 1.5 * direction_of(rad(deg_s) * t); });
  };
  EXPECT_EQ(label(bend(29.0), 2.0), Intention::kForward);
  EXPECT_EQ(label(bend(32.0), 2.0), Intention::kTurnLeft);
}

TEST(Truth, TwoTurnsAreTwoIfTheHeadingRestsBetweenThem) {
  const Truth twice = walk(14.0, [](double t) -> Vec2 {
    const double turned = std::clamp(t - 4.0, 0.0, 0.5) + std::clamp(t - 8.0, 0.0, 0.5);
    return 1.5 * direction_of(rad(180.0) * turned);
  });
  ASSERT_EQ(turns_of(twice).size(), 2u);
  EXPECT_NEAR(turns_of(twice)[1].begin_s - turns_of(twice)[0].begin_s, 4.0, 0.03);
}

TEST(GoesStraight, LooksThreeSecondsAheadForTurnsAndStops) {
  const Truth turn = left_turn(12.0, 6.0), stop = sudden_stop(12.0, 6.0);
  EXPECT_TRUE(goes_straight(turn, turn.steps(2.9)));
  EXPECT_FALSE(goes_straight(turn, turn.steps(3.2)));
  EXPECT_TRUE(goes_straight(turn, turn.steps(7.0))) << "after it";
  EXPECT_TRUE(goes_straight(stop, stop.steps(2.9)));
  EXPECT_FALSE(goes_straight(stop, stop.steps(3.2)));
  EXPECT_FALSE(goes_straight(stop, stop.steps(8.0))) << "who stands goes nowhere";
  EXPECT_FALSE(goes_straight(turn, turn.steps(9.5))) << "the three seconds are not known";
}

}  // namespace
}  // namespace foretrack
