// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/optimize_trajectory.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/planning/motion/check_trajectory.hpp"
#include "core/planning/motion/polynomial.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "tests/core/planning/random_problem.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

Vec3 position_at(const std::vector<QuinticPiece>& pieces, double t) {
  PlannedTrajectory trajectory;
  trajectory.pieces = pieces;
  return trajectory.position(t);
}

double duration_of(const std::vector<QuinticPiece>& pieces) {
  double sum = 0.0;
  for (const auto& piece : pieces) sum += piece.duration_s;
  return sum;
}

bool finite(const std::vector<QuinticPiece>& pieces) {
  for (const auto& piece : pieces)
    if (!std::isfinite(piece.duration_s) || !piece.coefficients.allFinite()) return false;
  return true;
}

TEST(OptimizeTrajectory, KeepsEndsCountsAndHorizonOnRandomProblems) {
  OptimizerState state;
  const OptimizerParams params;
  int improved = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const OptimizationProblem problem = make_random_problem(
        seed, {.polytopes_min = 1, .polytopes_max = 12, .paths = 1 + int(seed) % 3});
    const OptimizationResult& result = optimize_trajectory(state, problem, params);
    ASSERT_NE(result.status, OptimizationStatus::kNotFinite);
    ASSERT_EQ(result.pieces.size(), problem.durations_s.size());
    ASSERT_TRUE(finite(result.pieces));
    EXPECT_LE(result.iterations, params.iterations_max);
    EXPECT_LE(result.evaluations, params.evaluations_max);
    EXPECT_GT(duration_of(result.pieces), problem.min_total_duration_s - 1e-9);
    EXPECT_LT((result.pieces.front().position(0.0) - problem.start.position).norm(), 1e-9);
    const QuinticPiece& last = result.pieces.back();
    EXPECT_LT((last.velocity(last.duration_s) - problem.goal.velocity).norm(), 1e-6);
    EXPECT_LE(result.cost, result.initial_cost);
    improved += result.cost < 0.99 * result.initial_cost;
  }
  EXPECT_GT(improved, 100);
}

/// A roomy corridor, and a start beside the visible region of a target that stands still.
OptimizationProblem sector_problem(double weight_left, double weight_right) {
  OptimizationProblem problem;
  problem.start.position = Vec3(-2.0, 0.0, 1.5);
  problem.goal.position = Vec3(-2.0, 0.0, 1.5);
  Polytope box;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Eigen::Vector4d plane = Eigen::Vector4d::Zero();
      plane[axis] = sign;
      plane[3] = 6.0;
      box.planes.push_back(plane);
    }
  problem.corridor.assign(4, box);
  problem.inner_waypoints.assign(7, problem.start.position);
  problem.durations_s.assign(8, 3.0 / 8);
  for (const auto& [weight, bearing_rad] :
       {std::pair(weight_left, kPi - 0.9), std::pair(weight_right, kPi + 0.9)})
    for (int k = 1; k <= 10; ++k) {
      TargetSample sample;
      sample.time_s = 0.2 * k;
      sample.weight = weight;
      sample.target_enu_m = Vec3(0.0, 0.0, 1.0);
      sample.has_region = true;
      sample.bisector_rad = bearing_rad;
      sample.half_angle_rad = 0.5;
      problem.samples.push_back(sample);
    }
  return problem;
}

TEST(OptimizeTrajectory, MovesIntoTheVisibleRegionAndTheDistanceBand) {
  OptimizerState state;
  const OptimizationResult& result = optimize_trajectory(state, sector_problem(1.0, 0.0), {});
  const Vec3 p = position_at(result.pieces, 1.6);
  EXPECT_LT(std::abs(wrap_angle(yaw_of(Vec2(p.head<2>())) - (kPi - 0.9))), 0.65);
  EXPECT_GT(p.head<2>().norm(), 1.4);
  EXPECT_LT(p.head<2>().norm(), 2.6);
}

// Hedging: with two intentions the vehicle leans to the likelier side, and stays between equal
// ones.
TEST(OptimizeTrajectory, HedgesBetweenIntentionsByTheirProbability) {
  OptimizerState state;
  const auto side_m = [&](double left, double right) {
    return position_at(optimize_trajectory(state, sector_problem(left, right), {}).pieces, 1.6).y();
  };
  const double sure = side_m(1.0, 0.0), likely = side_m(0.9, 0.1), even = side_m(0.5, 0.5);
  EXPECT_GT(sure, likely);
  EXPECT_GT(likely, even + 0.05);
  EXPECT_NEAR(even, 0.0, 0.1);
  EXPECT_NEAR(side_m(0.1, 0.9), -likely, 0.1);
}

TEST(OptimizeTrajectory, StaysInsideTheCorridorAndTheLimits) {
  OptimizerState state;
  int inside = 0, within = 0;
  constexpr int kProblems = 100;
  for (int seed = 0; seed < kProblems; ++seed) {
    const OptimizationProblem problem = make_random_problem(seed);
    const OptimizationResult& result = optimize_trajectory(state, problem, {});
    bool contained = true;
    for (std::size_t i = 0; i < result.pieces.size(); ++i)
      for (int k = 0; k <= 20; ++k)
        contained &= problem.corridor[i / kPiecesPerPolytope].contains(
            result.pieces[i].position(result.pieces[i].duration_s * k / 20.0), 0.05);
    inside += contained;
    within += peak_norm(result.pieces, 1).value <= problem.limits.speed_max_m_s &&
              peak_norm(result.pieces, 2).value <= problem.limits.acceleration_max_m_s2;
  }
  EXPECT_GE(inside, 95);
  EXPECT_GE(within, 95);
}

TEST(OptimizeTrajectory, TakesMoreTimeWhereTheLimitsDemandIt) {
  OptimizationProblem problem = sector_problem(0.0, 0.0);
  problem.goal.position = Vec3(5.0, 5.0, 1.5);  // 8.6 m in 3 s at 3 m/s, rest to rest: impossible
  for (int i = 0; i < 7; ++i)
    problem.inner_waypoints[i] =
        problem.start.position + (i + 1) / 8.0 * (problem.goal.position - problem.start.position);
  OptimizerState state;
  const OptimizationResult& result = optimize_trajectory(state, problem, {});
  EXPECT_GT(duration_of(result.pieces), 3.3);
  EXPECT_LT(peak_norm(result.pieces, 1).value, 3.05);
  EXPECT_LT(peak_norm(result.pieces, 2).value, 5.05);
}

// However far away the target is: a plan that breaks the limits would never be flown. The weights
// are those of a plan's second attempt, which is the firm one.
TEST(OptimizeTrajectory, FarTargetsDoNotOutweighTheLimits) {
  OptimizerState state;
  OptimizerParams params;
  params.speed_weight *= 10.0;
  params.acceleration_weight *= 10.0;
  for (const double behind_m : {5.0, 10.0, 30.0})
    for (int seed = 0; seed < 30; ++seed) {
      const OptimizationProblem problem = make_random_problem(seed, {.behind_m = behind_m});
      const OptimizationResult& result = optimize_trajectory(state, problem, params);
      EXPECT_LE(peak_norm(result.pieces, 1).value, 1.001 * problem.limits.speed_max_m_s);
      EXPECT_LE(peak_norm(result.pieces, 2).value, 1.001 * problem.limits.acceleration_max_m_s2);
      EXPECT_LT(duration_of(result.pieces), 6.0);
    }
}

TEST(OptimizeTrajectory, SameProblemSameBitsWhateverWasSolvedBefore) {
  OptimizerState used, fresh;
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    optimize_trajectory(used, make_random_problem(seed, {.polytopes_max = 12, .paths = 3}), {});
  const OptimizationProblem problem = make_random_problem(42);
  const auto a = optimize_trajectory(used, problem, {}).pieces;
  const auto b = optimize_trajectory(fresh, problem, {}).pieces;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].duration_s, b[i].duration_s);
    EXPECT_EQ(a[i].coefficients, b[i].coefficients);
  }
}

TEST(OptimizeTrajectory, AllocatesNothingAfterTheFirstCall) {
  const OptimizationProblem largest =
      make_random_problem(1, {.polytopes_min = 20, .polytopes_max = 20, .paths = 3});
  const OptimizationProblem other = make_random_problem(2);
  const OptimizerParams params;
  OptimizerState state;
  optimize_trajectory(state, largest, params);
  const long before = allocation_count();
  optimize_trajectory(state, other, params);
  optimize_trajectory(state, largest, params);
  EXPECT_EQ(allocation_count() - before, 0);
}

TEST(OptimizeTrajectory, CheckAndStopTailAllocateNothing) {
  GridMap map;
  map.size = {40, 40, 20};
  map.cells.assign(map.cell_count(), 0);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  PlannedTrajectory trajectory;
  trajectory.pieces.reserve(4);
  trajectory.yaw.nodes.assign(4, {});
  const BoundaryState start{Vec3(1.0, 1.0, 1.5), Vec3(1.0, 0.5, 0.0), Vec3::Zero()};
  const long before = allocation_count();
  trajectory.pieces.push_back(make_stop_tail(start, {}).piece);
  const CheckResult result = check_trajectory(trajectory, {map, start, {}}, {}, {});
  EXPECT_EQ(allocation_count() - before, 0);
  EXPECT_TRUE(result.ok());
}

TEST(OptimizeTrajectory, NamesWhatIsWrongWithAProblem) {
  OptimizerState state;
  const auto message = [&](auto&& spoil) {
    OptimizationProblem problem = make_random_problem(3);
    spoil(problem);
    try {
      optimize_trajectory(state, problem, {});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(message([](auto&) {}), "accepted"));
  EXPECT_TRUE(has(message([](auto& p) { p.inner_waypoints.pop_back(); }), "inner waypoints"));
  EXPECT_TRUE(has(message([](auto& p) { p.corridor.pop_back(); }), "polytopes"));
  EXPECT_TRUE(has(message([](auto& p) { p.durations_s[1] = 0.0; }), "duration"));
  EXPECT_TRUE(has(message([](auto& p) { p.samples[0].time_s = 9.0; }), "sample"));
  EXPECT_TRUE(has(message([](auto& p) { p.start.velocity[0] = std::nan(""); }), "start"));
  EXPECT_TRUE(has(message([](auto& p) { p.durations_s.assign(100, 0.1); }), "100 pieces"));
}

}  // namespace
}  // namespace foretrack
