// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/penalties.hpp"

#include <gtest/gtest.h>

#include "core/common/moving_body.hpp"
#include "core/common/random.hpp"
#include "core/planning/optimize/trajectory_cost.hpp"
#include "tests/core/planning/random_problem.hpp"

namespace foretrack {
namespace {

template <class Add>
void expect_gradient(const Vec3& p, Add add) {
  PointPenalty at;
  add(p, at);
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = 1e-6 * Vec3::Unit(i);
    PointPenalty above, below;
    add(p + step, above);
    add(p - step, below);
    const double expected = (above.value - below.value) / 2e-6;
    EXPECT_NEAR(at.gradient[i], expected, 1e-6 * (1.0 + std::abs(expected))) << p.transpose();
  }
}

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

TEST(Penalties, PointGradientsAgreeWithFiniteDifferences) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(random, 4.0), target = random_point(random, 1.0);
    const Sector sector =
        make_sector(target, random.uniform(-kPi, kPi), random.uniform(0.0, kPi / 2));
    expect_gradient(p,
                    [&](const Vec3& x, PointPenalty& sum) { add_visibility(x, sector, 3.0, sum); });
    expect_gradient(p, [&](const Vec3& x, PointPenalty& sum) {
      add_distance_band(x, target, 1.5, 2.5, 2.0, sum);
    });
    const Pillar pillar{target, random.uniform(0.1, 0.5), random.uniform(0.5, 2.0)};
    expect_gradient(
        p, [&](const Vec3& x, PointPenalty& sum) { add_gap(x, 0.25, pillar, 1.5, 2.0, sum); });
    expect_gradient(
        p, [&](const Vec3& x, PointPenalty& sum) { add_height_band(x, 0.4, 0.3, 5.0, sum); });
  }
}

TEST(Penalties, TheGapCostsWhatIsMissingOfItInSpace) {
  Random random(2);
  const Pillar pillar{{0.5, -0.5, 0.0}, 0.3, 1.75};
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_point(random, 3.0);
    const double missing_m = 1.0 - gap_m(p, 0.25, pillar.foot, pillar.radius_m, pillar.height_m);
    PointPenalty sum;
    add_gap(p, 0.25, pillar, 1.0, 2.0, sum);
    EXPECT_NEAR(sum.value, missing_m > 0.0 ? 2.0 * std::pow(missing_m, 3) : 0.0, 2e-2);
    inside += missing_m > 1.25;
  }
  EXPECT_GT(inside, 3);
}

TEST(Penalties, VisibilityCostsNothingInsideTheSectorAndSomethingOutside) {
  const Sector sector = make_sector({1.0, 1.0, 0.0}, 0.5, 0.3);
  const auto cost_at = [&](double angle_rad) {
    PointPenalty sum;
    const Vec2 d = 2.0 * direction_of(angle_rad);
    add_visibility(Vec3(1.0 + d.x(), 1.0 + d.y(), 7.0), sector, 1.0, sum);
    return sum.value;
  };
  EXPECT_EQ(cost_at(0.25), 0.0);
  EXPECT_EQ(cost_at(0.75), 0.0);
  EXPECT_GT(cost_at(0.15), 0.0);
  EXPECT_GT(cost_at(0.85), 0.0);
}

// The paper prints both signs of the distance band reversed.
TEST(Penalties, DistanceBandPunishesOutsideTheBandOnly) {
  const auto cost_at = [](double distance_m) {
    PointPenalty sum;
    add_distance_band(Vec3(distance_m, 0.0, 3.0), Vec3::Zero(), 1.5, 2.5, 1.0, sum);
    return sum.value;
  };
  EXPECT_GT(cost_at(0.0), cost_at(1.0));
  EXPECT_GT(cost_at(1.0), 0.0);
  EXPECT_EQ(cost_at(2.0), 0.0);
  EXPECT_NEAR(cost_at(0.5), 1.0, 1e-3);
  EXPECT_NEAR(cost_at(2.6), 1e-3, 1e-5);
  // Far away it grows linearly: the pull has a limit.
  EXPECT_NEAR(cost_at(40.0) - cost_at(30.0), cost_at(20.0) - cost_at(10.0), 1e-6);
}

/// The quadrature as the paper writes it, from the polynomial itself.
double piece_penalty_by_sum(const Minco& minco, int piece, const Polytope& polytope,
                            const PieceWeights& weights) {
  const QuinticPiece quintic = piece_of(minco, piece);
  double sum = 0.0;
  for (int j = 0; j <= kQuadratureIntervals; ++j) {
    const double t = quintic.duration_s * j / kQuadratureIntervals;
    const double omega = j == 0 || j == kQuadratureIntervals ? 0.5 : 1.0;
    for (const auto& plane : polytope.planes)
      sum += omega * weights.corridor *
             cubed_hinge(plane.head<3>().dot(quintic.position(t)) - plane[3] +
                         weights.corridor_margin_m)
                 .value;
    const auto excess = [](const Vec3& u, double limit) {
      return cubed_hinge(u.squaredNorm() - limit * limit).value;
    };
    sum += omega * weights.speed * excess(quintic.velocity(t), weights.speed_limit_m_s);
    sum += omega * weights.acceleration *
           excess(quintic.acceleration(t), weights.acceleration_limit_m_s2);
  }
  return sum * quintic.duration_s / kQuadratureIntervals;
}

TEST(Penalties, PiecePenaltyIsTheTrapezoidSum) {
  const PieceWeights weights{1e4, 1e2, 1e1, 0.05, 0.8, 1.5};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const OptimizationProblem problem = make_random_problem(seed);
    TrajectoryCost cost;
    cost.prepare(problem, {});
    const Minco& minco = cost.minco();
    for (int i = 0; i < minco.pieces; ++i) {
      MincoGradient gradient;
      set_zero(gradient, minco.pieces);
      const Polytope& polytope = problem.corridor[i / kPiecesPerPolytope];
      const double expected = piece_penalty_by_sum(minco, i, polytope, weights);
      EXPECT_NEAR(add_piece_penalties(minco, i, polytope, weights, gradient), expected,
                  1e-8 * (1.0 + expected));
    }
  }
}

}  // namespace
}  // namespace foretrack
