// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/calibrate.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "core/prediction/assess_intention.hpp"
#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

IntentionAssessment assess(const TargetState& target, const GridMap& map) {
  const PredictionParams params;
  MotionMemory memory;
  const MotionCues motion = observe_motion(memory, target, params);
  const Surroundings surroundings = observe_surroundings(map, motion, params);
  IntentionAssessment assessment;
  assess_intention(motion, surroundings, params, assessment);
  calibrate(motion, surroundings, params, !map.empty(), assessment);
  return assessment;
}

double probability(const IntentionAssessment& a, Intention i) {
  return a[i].probability;
}

TEST(Calibrate, GivesADistributionForAnyEvidence) {
  Random random(1);
  const PredictionParams params;
  for (const bool map_known : {false, true})
    for (const bool body_known : {false, true})
      for (int i = 0; i < 50; ++i) {
        const auto any = [&] { return random.normal(0.0, 100.0); };
        MotionCues motion;
        motion.body_known = body_known;
        motion.speed_m_s = std::abs(any()), motion.speed_fall_m_s = any();
        motion.body_turn_rad = any(), motion.soon_turn_rad = any();
        Surroundings surroundings;
        surroundings.obstacle_distance_m = std::abs(any());
        for (double& w : surroundings.left_width_m) w = std::abs(any());
        IntentionAssessment a;
        assess_intention(motion, surroundings, params, a);
        calibrate(motion, surroundings, params, map_known, a);
        double sum = 0.0;
        for (const IntentionRow& row : kIntentions) {
          const double p = a[row.id].probability;
          EXPECT_TRUE(p >= 0.0 && p <= 1.0);
          sum += p;
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
      }
}

TEST(Calibrate, IsTheLogisticModelItClaimsToBe) {
  LogitWeights<3> w;
  w.row = {-1.0, 0.0, 0.5};
  w.hidden[3][1] = 2.0, w.hidden_bias[3] = -0.3, w.hidden_gain[3] = 1.5;
  const std::array<double, 3> features = {1.0, 0.4, 2.0};
  EXPECT_NEAR(logit_of(LogitView(w), features), -1.0 + 1.0 + 1.5 * std::tanh(-0.3 + 0.8), 1e-12);
  EXPECT_THROW(logit_of(LogitView(w), std::span(features).first(2)), std::logic_error);
}

TEST(Calibrate, EveryShippedIntentionIsFittedInEveryStateOfKnowledge) {
  EXPECT_TRUE(unfitted().empty());
  for (const IntentionRow& row : IntentionTable(kIntentions).subspan(1))
    for (const bool map_known : {false, true})
      for (const bool body_known : {false, true})
        EXPECT_EQ(row.head->weights(map_known, body_known).row.size(), row.head->features);
}

TEST(Calibrate, IsMirroredWhenTheWorldIs) {
  const GridMap left = left_branch();
  const GridMap right = map_of({{-8, 0, -8, -1}, {-8, 8, 1, 8}, {2, 8, -8, -1}});
  TargetState target = walker({-0.9, 0.0}, {1.5, 0.0});
  target.body_yaw_rad = 0.3;
  const auto a = assess(target, left);
  target.body_yaw_rad = -0.3;
  const auto b = assess(target, right);
  EXPECT_NEAR(probability(a, Intention::kTurnLeft), probability(b, Intention::kTurnRight), 0.02);
  EXPECT_NEAR(probability(a, Intention::kForward), probability(b, Intention::kForward), 0.02);
}

TEST(Calibrate, ExpectsATurnAtABendMoreThanInTheOpen) {
  const TargetState target = walker({0.2, 0.0}, {1.5, 0.0});
  const double bend = probability(assess(target, left_corner()), Intention::kTurnLeft);
  const double open = probability(assess(target, open_field()), Intention::kTurnLeft);
  EXPECT_GT(bend, 0.5);
  EXPECT_LT(open, 0.2);
}

TEST(Calibrate, ExpectsWhoWalksOnWithoutMapOrBodyToGoOn) {
  TargetState target = walker({0, 0}, {1.3, 0.0});
  target.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(probability(assess(target, GridMap{}), Intention::kForward), 0.9);
}

}  // namespace
}  // namespace foretrack
