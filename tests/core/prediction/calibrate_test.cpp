// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/calibrate.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/common/random.hpp"
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
  calibrate(motion, surroundings, !map.empty(), assessment);
  return assessment;
}

double probability(const IntentionAssessment& a, Intention i) {
  return a[i].probability;
}

TEST(Calibrate, GivesADistributionForAnyFeatures) {
  Random random(1);
  for (const bool map_known : {false, true})
    for (const bool body_known : {false, true})
      for (int i = 0; i < 50; ++i) {
        IntentionFeatures f;
        for (auto* side : {&f.left, &f.right})
          for (double& x : *side) x = random.normal(0.0, 100.0);
        for (double& x : f.decelerate) x = random.normal(0.0, 100.0);
        const auto p = probabilities(f, calibration_weights(map_known, body_known));
        EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
        for (const double x : p) EXPECT_TRUE(x >= 0.0 && x <= 1.0);
      }
}

TEST(Calibrate, IsTheLogisticModelItClaimsToBe) {
  CalibrationWeights w;
  w.turn.row[0] = -1.0, w.turn.row[2] = 0.5;
  w.turn.hidden[3][1] = 2.0, w.turn.hidden_bias[3] = -0.3, w.turn.hidden_gain[3] = 1.5;
  w.decelerate.row[0] = 0.2;
  w.decelerate.hidden[0][1] = 1.0, w.decelerate.hidden_gain[0] = -0.5;
  IntentionFeatures f;
  f.left = {1.0, 0.4, 2.0};
  f.right = {1.0, -0.7, 1.0};
  f.decelerate = {1.0, 0.6};
  const double left = -1.0 + 1.0 + 1.5 * std::tanh(-0.3 + 0.8);
  const double right = -1.0 + 0.5 + 1.5 * std::tanh(-0.3 - 1.4);
  const double decelerate = 0.2 - 0.5 * std::tanh(0.6);
  const double sum = 1.0 + std::exp(left) + std::exp(right) + std::exp(decelerate);
  const auto p = probabilities(f, w);
  EXPECT_NEAR(p[0], 1.0 / sum, 1e-12);
  EXPECT_NEAR(p[1], std::exp(left) / sum, 1e-12);
  EXPECT_NEAR(p[2], std::exp(right) / sum, 1e-12);
  EXPECT_NEAR(p[3], std::exp(decelerate) / sum, 1e-12);
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
