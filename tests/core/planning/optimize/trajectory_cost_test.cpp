// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/trajectory_cost.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "tests/core/planning/random_problem.hpp"

namespace foretrack {
namespace {

void keep_only(OptimizerParams& p, double OptimizerParams::*weight) {
  for (auto other : {&OptimizerParams::time_weight, &OptimizerParams::corridor_weight,
                     &OptimizerParams::speed_weight, &OptimizerParams::acceleration_weight,
                     &OptimizerParams::visibility_weight, &OptimizerParams::next_visibility_weight,
                     &OptimizerParams::distance_weight, &OptimizerParams::height_weight,
                     &OptimizerParams::gap_weight})
    if (other != weight) p.*other = 0.0;
}

/// The whole cost's gradient by waypoints and by the durations' variables.
class TrajectoryCostGradient : public ::testing::TestWithParam<double OptimizerParams::*> {};

TEST_P(TrajectoryCostGradient, AgreesWithFiniteDifferences) {
  OptimizerParams params;
  if (GetParam()) keep_only(params, GetParam());
  params.limit_fraction = 0.4;  // so that speed and acceleration are exceeded
  int active = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const OptimizationProblem problem =
        make_random_problem(seed, {.paths = 1 + int(seed) % 3, .bodies = true});
    TrajectoryCost cost;
    cost.prepare(problem, params);
    Random random(seed);
    Variables x = cost.first_guess(), gradient(x.size()), unused(x.size());
    for (double& value : x) value += random.normal(0.0, 0.15);
    cost.evaluate(x, gradient);
    for (int i = 0; i < x.size(); ++i) {
      const double step = 1e-6, middle = x[i];
      x[i] = middle + step;
      const double above = cost.evaluate(x, unused);
      x[i] = middle - step;
      const double below = cost.evaluate(x, unused);
      x[i] = middle;
      const double expected = (above - below) / (2.0 * step);
      active += std::abs(expected) > 1.0;
      EXPECT_NEAR(gradient[i], expected, 2e-5 * (gradient.norm() + 1.0)) << seed << " " << i;
    }
  }
  EXPECT_GT(active, 5);
}

INSTANTIATE_TEST_SUITE_P(
    EachTerm, TrajectoryCostGradient,
    ::testing::Values(nullptr, &OptimizerParams::time_weight, &OptimizerParams::corridor_weight,
                      &OptimizerParams::speed_weight, &OptimizerParams::acceleration_weight,
                      &OptimizerParams::visibility_weight, &OptimizerParams::next_visibility_weight,
                      &OptimizerParams::distance_weight, &OptimizerParams::height_weight,
                      &OptimizerParams::gap_weight));

double energy(const Minco& minco) {
  MincoGradient unused;
  set_zero(unused, minco.pieces);
  return add_jerk_energy(minco, unused);
}

TEST(TrajectoryCost, TheFirstGuessIsSmootherThanTheWaypointsItIsGiven) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const OptimizationProblem problem = make_random_problem(seed);
    TrajectoryCost cost;
    cost.prepare(problem, {});
    Variables given = cost.first_guess();
    cost.set_trajectory(given);
    const double smooth = energy(cost.minco());
    for (std::size_t i = 0; i < problem.inner_waypoints.size(); ++i)
      given.segment<3>(static_cast<Eigen::Index>(3 * i)) = problem.inner_waypoints[i];
    cost.set_trajectory(given);
    EXPECT_LT(smooth, energy(cost.minco())) << seed;
  }
}

TEST(TrajectoryCost, SlowingDownStretchesEveryPiece) {
  const OptimizationProblem problem = make_random_problem(3);
  TrajectoryCost cost;
  cost.prepare(problem, {});
  const Minco before = cost.minco();
  cost.slow_down(1.5);
  for (int i = 0; i < before.pieces; ++i)
    EXPECT_NEAR(cost.minco().durations_s[i], 1.5 * before.durations_s[i], 1e-12);
}

}  // namespace
}  // namespace foretrack
