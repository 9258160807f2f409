// SPDX-License-Identifier: Apache-2.0
#include "core/scores/score_paths.hpp"

#include <gtest/gtest.h>

#include "tests/core/scores/walks.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

PathErrors at(const PathScorer& scorer, PathWindows windows, PathKind kind, int horizon) {
  return scorer.means(windows)[static_cast<std::size_t>(kind)][static_cast<std::size_t>(horizon)];
}

// Straight ahead, its end moved sideways.
PredictedPath path_of(const TargetState& target, double probability, double aside_m) {
  PredictedPath path;
  path.probability = probability;
  for (int k = 1; k <= 15; ++k) {
    PredictedState& z = path.states.emplace_back();
    z.time_s = 0.2 * k;
    z.position_enu_m = target.position_enu_m + z.time_s * target.velocity_enu_m_s;
    z.position_enu_m.y() += aside_m * z.time_s / 3.0;
    z.velocity_enu_m_s = target.velocity_enu_m_s + Vec3(0.0, aside_m / 3.0, 0.0);
  }
  return path;
}

// Estimates are the truth.
PathScorer score(const Truth& truth, const std::vector<double>& asides_m) {
  PathScorer scorer;
  HeadingRate heading_rate;
  for (int i = 0; i < truth.count(); i += 5) {
    TargetState target;
    target.position_enu_m << truth.samples[i].position_m, 1.2;
    target.velocity_enu_m_s << truth.samples[i].velocity_m_s, 0.0;
    const double rate_rad_s = heading_rate.next(i * kStep_s, truth.samples[i].velocity_m_s);
    Prediction prediction;
    for (std::size_t k = 0; k < asides_m.size(); ++k)
      prediction.paths.push_back(path_of(target, k == 0 ? 0.8 : 0.2, asides_m[k]));
    scorer.add(target, rate_rad_s, prediction, truth, i * kStep_s);
  }
  return scorer;
}

TEST(PathScorer, AStraightWalkIsExactForConstantVelocityAndConstantTurn) {
  const PathScorer scorer = score(straight_walk(10.0), {0.0});
  for (const PathKind kind :
       {PathKind::kMostProbable, PathKind::kConstantVelocity, PathKind::kConstantTurn}) {
    EXPECT_GT(at(scorer, PathWindows::kStraight, kind, 3).count, 30);
    EXPECT_NEAR(at(scorer, PathWindows::kStraight, kind, 3).fde_m, 0.0, 1e-6);
  }
  EXPECT_EQ(at(scorer, PathWindows::kTurning, PathKind::kBest, 0).count, 0);
}

TEST(PathScorer, ACircleIsExactForConstantTurnAlone) {
  const Truth circle =
      walk(12.0, [](double t) -> Vec2 { return 1.5 * direction_of(0.6 * (t + 0.5 * kStep_s)); });
  const PathScorer scorer = score(circle, {0.0});
  EXPECT_LT(at(scorer, PathWindows::kTurning, PathKind::kConstantTurn, 2).fde_m, 0.15);
  // Chord against tangent: 2 s on the circle.
  const Vec2 truth = 2.5 * Vec2(std::sin(1.2), 1.0 - std::cos(1.2));
  EXPECT_NEAR(at(scorer, PathWindows::kTurning, PathKind::kConstantVelocity, 2).fde_m,
              (truth - Vec2(3.0, 0.0)).norm(), 0.02);
}

TEST(PathScorer, TheBestPathIsJudgedByItsEndAndItsProbability) {
  const PathScorer scorer = score(straight_walk(10.0), {1.5, 0.3});
  const PathErrors first = at(scorer, PathWindows::kAll, PathKind::kMostProbable, 3);
  const PathErrors best = at(scorer, PathWindows::kAll, PathKind::kBest, 3);
  EXPECT_NEAR(first.fde_m, 1.5, 1e-6);
  EXPECT_NEAR(first.ade_m, 1.5 * 31.0 / 60.0, 1e-6);
  EXPECT_NEAR(first.missed_one_m, 1.0, 1e-9);
  EXPECT_NEAR(first.brier_fde_m, 1.5 + 0.04, 1e-6);
  EXPECT_NEAR(best.fde_m, 0.3, 1e-6);
  EXPECT_NEAR(best.brier_fde_m, 0.3 + 0.64, 1e-6);
  EXPECT_EQ(best.missed_half_m, 0.0);
}

TEST(PathScorer, WhatTheTruthDoesNotReachDoesNotCount) {
  const PathScorer scorer = score(straight_walk(2.5), {0.0});
  EXPECT_EQ(at(scorer, PathWindows::kAll, PathKind::kMostProbable, 3).count, 0);  // 3 s ahead
  EXPECT_GT(at(scorer, PathWindows::kAll, PathKind::kMostProbable, 1).count, 0);
}

TEST(PathScorer, WalksAddUp) {
  PathScorer both = score(straight_walk(8.0), {0.6});
  const int count = at(both, PathWindows::kAll, PathKind::kBest, 1).count;
  both += score(straight_walk(8.0), {0.0});
  EXPECT_EQ(at(both, PathWindows::kAll, PathKind::kBest, 1).count, 2 * count);
  EXPECT_NEAR(at(both, PathWindows::kAll, PathKind::kBest, 1).fde_m, 0.1, 1e-6);
}

}  // namespace
}  // namespace foretrack
