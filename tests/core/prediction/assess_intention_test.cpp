// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/assess_intention.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

Surroundings open_surroundings() {
  Surroundings s;
  s.obstacle_distance_m = PredictionParams{}.obstacle_range_m;
  s.region.left_half_angle_rad = s.region.right_half_angle_rad = 0.3;
  s.region_ahead.left_half_angle_rad = s.region_ahead.right_half_angle_rad = 0.3;
  return s;
}

MotionCues walking(double speed_m_s) {
  MotionCues m;
  m.state.velocity_m_s = {speed_m_s, 0.0};
  m.speed_m_s = speed_m_s;
  m.walking = true;
  return m;
}

IntentionAssessment assess(const MotionCues& motion, const Surroundings& surroundings,
                           const PredictionParams& params = {}) {
  IntentionAssessment assessment;
  assess_intention(motion, surroundings, params, assessment);
  return assessment;
}

TEST(AssessIntention, GivesForwardTheHighestScoreWhenNothingSpeaksAgainstIt) {
  const auto a = assess(walking(1.5), open_surroundings());
  for (const Intention i : {Intention::kTurnLeft, Intention::kTurnRight, Intention::kDecelerate}) {
    EXPECT_EQ(a[i].potential, 0.0);
    EXPECT_EQ(a[i].observation, 0.0);
    EXPECT_LT(a[i].score, a[Intention::kForward].score);
  }
}

TEST(AssessIntention, MixesAllThatIsSaidOfAnIntentionAndReadsTheMarginsAnew) {
  MotionCues aside = walking(1.5);
  aside.body_turn_rad = 0.8;
  const Surroundings s = open_surroundings();
  IntentionAssessment seen = assess(aside, s);
  IntentionAssessment faceless = assess(walking(1.5), s);
  IntentionBelief& left = seen[Intention::kTurnLeft];
  const IntentionBelief before = left, other = faceless[Intention::kTurnLeft];
  left.probability = 0.9;
  faceless[Intention::kTurnLeft].probability = 0.1;
  mix(seen, faceless, 0.25);
  EXPECT_NEAR(left.observation, 0.25 * before.observation + 0.75 * other.observation, 1e-12);
  EXPECT_NEAR(left.score, 0.25 * before.score + 0.75 * other.score, 1e-12);
  EXPECT_NEAR(left.probability, 0.3, 1e-12);
  EXPECT_GT(before.score, 2.0 * other.score) << "there is something to mix";
  EXPECT_EQ(seen.margins.left, left.score);
}

TEST(AssessIntention, FollowsThePapersFormulas) {
  PredictionParams p;
  p.k1_turn_potential = 2.0, p.k2_turn_observation = 3.0, p.k3_decelerate_potential = 0.5;
  p.k4_decelerate_observation = 4.0, p.k4_forward_potential = 0.7, p.k5_forward_observation = 0.9;
  p.b0_sensitivity = 0.8, p.b1_forward_potential = 1.1, p.b2_forward_observation = 1.3;
  Surroundings s = open_surroundings();
  s.region_ahead.left_half_angle_rad = 0.5;
  s.obstacle_distance_m = 2.0;
  MotionCues m = walking(1.5);
  m.body_turn_rad = 0.4;
  m.speed_fall_m_s = 0.2;
  const auto a = assess(m, s, p);
  EXPECT_NEAR(a[Intention::kTurnLeft].potential, 2.0 * 0.2, 1e-12);
  EXPECT_NEAR(a[Intention::kTurnLeft].observation, 3.0 * 0.4, 1e-12);
  EXPECT_EQ(a[Intention::kTurnRight].potential, 0.0);
  EXPECT_EQ(a[Intention::kTurnRight].observation, 0.0);
  EXPECT_NEAR(a[Intention::kDecelerate].potential, 0.5 * 1.5 * 1.5 / 2.0, 1e-12);
  EXPECT_NEAR(a[Intention::kDecelerate].observation, 4.0 * 0.2, 1e-12);
  const double r_cv = -0.7 * (0.5 * 2.25 / 2.0) + 1.1, o_cv = -0.9 * 1.2 + 1.3;
  EXPECT_NEAR(a[Intention::kForward].potential, r_cv, 1e-12);
  EXPECT_NEAR(a[Intention::kForward].observation, o_cv, 1e-12);
  EXPECT_NEAR(a[Intention::kForward].score, 0.5 * (std::tanh(r_cv + o_cv - 0.8) + 1.0), 1e-12);
}

TEST(AssessIntention, IsMirroredWhenTheWorldIs) {
  Surroundings s = open_surroundings(), t = s;
  s.region_ahead.left_half_angle_rad = t.region_ahead.right_half_angle_rad = 0.6;
  MotionCues m = walking(1.0), n = m;
  m.body_turn_rad = 0.5, n.body_turn_rad = -0.5;
  const auto a = assess(m, s), b = assess(n, t);
  EXPECT_EQ(a[Intention::kTurnLeft].score, b[Intention::kTurnRight].score);
  EXPECT_EQ(a[Intention::kTurnRight].score, b[Intention::kTurnLeft].score);
  EXPECT_EQ(a[Intention::kForward].score, b[Intention::kForward].score);
}

TEST(AssessIntention, StaysFiniteAtAWall) {
  Surroundings s = open_surroundings();
  s.obstacle_distance_m = 0.0;
  const PredictionParams p;
  const auto a = assess(walking(2.0), s, p);
  EXPECT_NEAR(a[Intention::kDecelerate].potential,
              p.k3_decelerate_potential * 4.0 / p.obstacle_floor_m, 1e-12);
}

TEST(AssessIntention, AsksForTheMarginThatARowNamesByItsScore) {
  IntentionAssessment a;
  a[Intention::kTurnLeft].score = 0.7;
  a[Intention::kTurnRight].score = 0.2;
  a[Intention::kDecelerate].score = 0.4;
  const MarginScores margins = margin_scores(a);
  EXPECT_EQ(margins.left, 0.7);
  EXPECT_EQ(margins.right, 0.2);
  EXPECT_EQ(margins.distance, 0.4);
}

}  // namespace
}  // namespace foretrack
