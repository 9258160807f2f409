#include "services/experiments/path_scores.hpp"

#include <gtest/gtest.h>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

PathErrors at(const PathTable& table, PathKind kind, int horizon) {
  return table[static_cast<std::size_t>(kind)][static_cast<std::size_t>(horizon)];
}

// A target on a circle (rate 0: straight) at 1.5 m/s; estimates are the truth.
std::vector<FlightRow> walk(double rate_rad_s, double for_s) {
  std::vector<FlightRow> rows;
  for (int i = 1; i <= std::lround(for_s / kStep_s); ++i) {
    FlightRow& row = rows.emplace_back();
    row.now_s = i * kStep_s;
    const double yaw = rate_rad_s * row.now_s;
    row.target.velocity_enu_m_s << 1.5 * direction_of(yaw), 0.0;
    if (rate_rad_s == 0.0)
      row.target.position_enu_m = {1.5 * row.now_s, 0.0, 1.2};
    else
      row.target.position_enu_m = {1.5 / rate_rad_s * std::sin(yaw),
                                   1.5 / rate_rad_s * (1.0 - std::cos(yaw)), 1.2};
  }
  return rows;
}

TargetState estimate_of(const FlightRow& row) {
  TargetState target;
  target.status = TrackStatus::kTracking;
  target.stamp_s = row.now_s;
  target.position_enu_m = row.target.position_enu_m;
  target.velocity_enu_m_s = row.target.velocity_enu_m_s;
  return target;
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
  }
  return path;
}

PathTable score(const std::vector<FlightRow>& rows, const std::vector<double>& asides_m) {
  PathScorer scorer;
  for (std::size_t i = 4; i < rows.size(); i += 5) {
    const TargetState target = estimate_of(rows[i]);
    Prediction prediction;
    for (std::size_t k = 0; k < asides_m.size(); ++k)
      prediction.paths.push_back(path_of(target, k == 0 ? 0.8 : 0.2, asides_m[k]));
    scorer.add(target, prediction);
  }
  return scorer.scores(rows);
}

TEST(PathScorer, AStraightWalkIsExactForConstantVelocityAndConstantTurn) {
  const PathTable table = score(walk(0.0, 10.0), {0.0});
  for (const PathKind kind :
       {PathKind::kMostProbable, PathKind::kConstantVelocity, PathKind::kConstantTurn}) {
    EXPECT_GT(at(table, kind, 3).count, 30);
    EXPECT_NEAR(at(table, kind, 3).fde_m, 0.0, 1e-6);
  }
}

TEST(PathScorer, ACircleIsExactForConstantTurnAlone) {
  const PathTable table = score(walk(0.5, 12.0), {0.0});
  const double n = at(table, PathKind::kConstantTurn, 2).count;
  EXPECT_LT(at(table, PathKind::kConstantTurn, 2).fde_m / n, 0.1);  // the first has no past yet
  // Chord against tangent: 2 s on the circle.
  const Vec2 truth = 3.0 * Vec2(std::sin(1.0), 1.0 - std::cos(1.0));
  EXPECT_NEAR(at(table, PathKind::kConstantVelocity, 2).fde_m / n, (truth - Vec2(3.0, 0.0)).norm(),
              1e-6);
}

TEST(PathScorer, TheBestPathIsJudgedByItsEndAndItsProbability) {
  const PathTable table = score(walk(0.0, 10.0), {1.5, 0.3});
  const PathErrors first = at(table, PathKind::kMostProbable, 3);
  const PathErrors best = at(table, PathKind::kBest, 3);
  EXPECT_NEAR(first.fde_m / first.count, 1.5, 1e-6);
  EXPECT_NEAR(first.ade_m / first.count, 1.5 * 31.0 / 60.0, 1e-6);
  EXPECT_NEAR(first.missed_one_m / first.count, 1.0, 1e-9);
  EXPECT_NEAR(first.brier_fde_m / first.count, 1.5 + 0.04, 1e-6);
  EXPECT_NEAR(best.fde_m / best.count, 0.3, 1e-6);
  EXPECT_NEAR(best.brier_fde_m / best.count, 0.3 + 0.64, 1e-6);
  EXPECT_EQ(best.missed_half_m, 0.0);
}

TEST(PathScorer, WhatTheFlightDidNotSeeDoesNotCount) {
  const PathTable table = score(walk(0.0, 2.5), {0.0});
  EXPECT_EQ(at(table, PathKind::kMostProbable, 3).count, 0);  // 3 s ahead
  EXPECT_GT(at(table, PathKind::kMostProbable, 1).count, 0);
}

}  // namespace
}  // namespace foretrack
