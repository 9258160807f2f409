// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace foretrack {
namespace {

const std::vector<Vec2> kRoute = {{0, 0}, {6, 0}, {6, 8}, {2, 4}, {2, 3.5}, {9, 3.5}};

double distance_to_route(const Vec2& p, const std::vector<Vec2>& route) {
  double least = 1e9;
  for (std::size_t i = 1; i < route.size(); ++i) {
    const Vec2 a = route[i - 1], ab = route[i] - a;
    const double u = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - u * ab).norm());
  }
  return least;
}

TEST(WalkAlong, StaysWithinSpeedAndAccelerationAndNearTheRoute) {
  for (const double speed : {0.7, 1.5, 2.0}) {
    const WalkLimits limits{speed, 3.0, 0.45};
    const Walk walk = walk_along(kRoute, limits);
    for (double t = 0.0; t < walk.duration_s(); t += 0.003) {
      const WalkPoint p = walk.at(t);
      EXPECT_LE(p.velocity_m_s.norm(), speed + 1e-9);
      EXPECT_LE(p.acceleration_m_s2.norm(), 3.0 + 1e-9);
      // A 90° corner is cut by reach·cos(45°)/2, sharper ones by less.
      EXPECT_LE(distance_to_route(p.position_m, kRoute), 0.45 * 0.7072 / 2.0 + 1e-9);
    }
  }
}

TEST(WalkAlong, IsContinuousAndItsDerivativesAgreeWithFiniteDifferences) {
  const Walk walk = walk_along(kRoute, {});
  const double h = 1e-5;
  for (double t = 0.01; t < walk.duration_s() - 0.01; t += 0.0173) {
    const Vec2 slope = (walk.at(t + h).position_m - walk.at(t - h).position_m) / (2.0 * h);
    EXPECT_LT((slope - walk.at(t).velocity_m_s).norm(), 1e-4) << t;
    EXPECT_LT((walk.at(t + h).velocity_m_s - walk.at(t - h).velocity_m_s).norm(), 3.1 * 2.0 * h);
  }
}

TEST(WalkAlong, BeginsAndEndsAtRestAtTheEndsOfTheRoute) {
  const Walk walk = walk_along(kRoute, {});
  EXPECT_EQ(walk.at(-1.0).position_m, kRoute.front());
  EXPECT_LT((walk.at(walk.duration_s() + 5.0).position_m - kRoute.back()).norm(), 1e-6);
  EXPECT_EQ(walk.at(walk.duration_s() + 5.0).velocity_m_s, Vec2::Zero());
}

TEST(WalkAlong, StraightWalkTakesTheAnalyticTime) {
  // Ramps of v/a each, covering v²/a in all; the rest at full speed.
  const Walk walk = walk_along(std::vector<Vec2>{{0, 0}, {10, 0}}, {2.0, 3.0, 0.45});
  EXPECT_NEAR(walk.duration_s(), 2.0 * 2.0 / 3.0 + (10.0 - 4.0 / 3.0) / 2.0, 1e-9);
  // Too short to reach the speed: 2·√(d/a).
  const Walk hop = walk_along(std::vector<Vec2>{{0, 0}, {0.5, 0}}, {2.0, 3.0, 0.45});
  EXPECT_NEAR(hop.duration_s(), 2.0 * std::sqrt(0.5 / 3.0), 1e-9);
}

TEST(WalkAlong, UTurnComesBackOnTheSameLine) {
  const Walk walk = walk_along(std::vector<Vec2>{{0, 0}, {5, 0}, {1, 0}}, {1.5, 3.0, 0.45});
  EXPECT_NEAR(walk.at(walk.duration_s()).position_m.x(), 1.0, 1e-6);
  for (double t = 0.0; t < walk.duration_s(); t += 0.01) {
    EXPECT_NEAR(walk.at(t).position_m.y(), 0.0, 1e-9);
    EXPECT_LT(walk.at(t).position_m.x(), 5.0 + 1e-9);
  }
}

TEST(WalkAlong, OnePointStandsAndNoneIsRefused) {
  const Walk walk = walk_along(std::vector<Vec2>{{3, 4}}, {});
  EXPECT_EQ(walk.at(7.0).position_m, Vec2(3, 4));
  EXPECT_THROW(walk_along(std::vector<Vec2>{}, {}), std::invalid_argument);
}

TEST(WalkThrough, PassesThePointsWithContinuousAcceleration) {
  std::vector<TrackPoint> points;
  for (int i = 0; i < 12; ++i) points.push_back({2.0 + 0.4 * i, {0.6 * i, std::sin(0.7 * i)}});
  const Walk walk = walk_through(points);
  for (const auto& p : points)
    EXPECT_LT((walk.at(p.time_s - 2.0).position_m - p.position_m).norm(), 1e-9);
  for (int i = 1; i < 11; ++i) {
    const double t = 0.4 * i;
    EXPECT_LT((walk.at(t - 1e-7).acceleration_m_s2 - walk.at(t + 1e-7).acceleration_m_s2).norm(),
              1e-4);
  }
  EXPECT_LT(walk.at(1e-9).acceleration_m_s2.norm(), 1e-6);  // natural ends
}

TEST(WalkThrough, RefusesTimesThatDoNotIncrease) {
  const std::vector<TrackPoint> points = {{0.0, {0, 0}}, {0.4, {1, 0}}, {0.4, {2, 0}}};
  EXPECT_THROW(walk_through(points), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
