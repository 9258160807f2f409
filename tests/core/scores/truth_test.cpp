// SPDX-License-Identifier: Apache-2.0
#include "core/scores/truth.hpp"

#include <gtest/gtest.h>

#include "tests/core/scores/walks.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

TEST(Truth, LabelsAreThoseOfTheNextSecond) {
  const Truth turn = left_turn(10.0, 4.0), stop = sudden_stop(10.0, 4.0);
  const auto label = [](const Truth& truth, double t) { return label_at(truth, truth.steps(t)); };
  EXPECT_EQ(label(turn, 2.5), Intention::kForward);
  EXPECT_EQ(label(turn, 3.5), Intention::kTurnLeft);
  EXPECT_EQ(label(turn, 6.0), Intention::kForward);
  EXPECT_EQ(label(stop, 3.5), Intention::kDecelerate);
  EXPECT_EQ(label(stop, 6.0), std::nullopt) << "who stands has none";
  EXPECT_EQ(label(turn, 9.5), std::nullopt) << "the future is not known";
}

TEST(Truth, WhoSlowsDownForACornerTurns) {
  const Truth corner = walk(10.0, [](double t) -> Vec2 {
    const double speed = t < 4.0 ? 1.5 : std::max(0.5, 1.5 - 3.0 * (t - 4.0));
    return speed * direction_of(rad(180.0) * std::clamp(t - 4.6, 0.0, 0.5));
  });
  EXPECT_EQ(label_at(corner, corner.steps(3.5)), Intention::kTurnLeft);
  EXPECT_TRUE(stops_of(corner).empty());
}

TEST(Truth, FindsEachTurnAndStopOnceWhereItBegins) {
  const auto turns = turns_of(left_turn(10.0, 4.0));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].kind, Intention::kTurnLeft);
  EXPECT_NEAR(turns[0].onset_s, 4.0 + 5.0 / 180.0, 0.021);
  EXPECT_TRUE(stops_of(left_turn(10.0, 4.0)).empty());
  const auto stops = stops_of(sudden_stop(10.0, 4.0));
  ASSERT_EQ(stops.size(), 1u);
  EXPECT_NEAR(stops[0].onset_s, 4.0 + 0.05 * 1.5 / 3.0, 0.021);
}

TEST(Truth, ATurnToTheOtherSideHasTheOtherLabel) {
  const Truth right = walk(10.0, [](double t) -> Vec2 {
    return 1.5 * direction_of(-rad(180.0) * std::clamp(t - 4.0, 0.0, 0.5));
  });
  EXPECT_EQ(label_at(right, right.steps(3.5)), Intention::kTurnRight);
  ASSERT_EQ(turns_of(right).size(), 1u);
  EXPECT_EQ(turns_of(right)[0].kind, Intention::kTurnRight);
}

TEST(Truth, ABendOfLessThanThirtyDegreesInASecondIsNoTurn) {
  const auto bend = [](double deg_s) {
    return walk(10.0, [=](double t) -> Vec2 { return 1.5 * direction_of(rad(deg_s) * t); });
  };
  EXPECT_EQ(label_at(bend(29.0), 100), Intention::kForward);
  EXPECT_EQ(label_at(bend(32.0), 100), Intention::kTurnLeft);
}

TEST(Truth, TwoTurnsAreTwoIfTheHeadingRestsBetweenThem) {
  const Truth twice = walk(14.0, [](double t) -> Vec2 {
    const double turned = std::clamp(t - 4.0, 0.0, 0.5) + std::clamp(t - 8.0, 0.0, 0.5);
    return 1.5 * direction_of(rad(180.0) * turned);
  });
  ASSERT_EQ(turns_of(twice).size(), 2u);
  EXPECT_NEAR(turns_of(twice)[1].onset_s - turns_of(twice)[0].onset_s, 4.0, 0.03);
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
