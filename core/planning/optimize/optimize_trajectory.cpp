// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/optimize_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/planning/motion/polynomial.hpp"
#include "core/planning/optimize/trajectory_cost.hpp"

namespace foretrack {
namespace {

constexpr int kSlowdownsMax = 6;
constexpr double kSlowdown = 1.06;

[[noreturn]] void reject(const std::string& what) {
  throw std::invalid_argument("optimize_trajectory: " + what);
}

bool finite(const BoundaryState& s) {
  return s.position.allFinite() && s.velocity.allFinite() && s.acceleration.allFinite();
}

bool finite(const TargetSample& s) {
  return s.target_enu_m.allFinite() && s.next_target_enu_m.allFinite() &&
         std::isfinite(s.time_s + s.weight + s.bisector_rad + s.half_angle_rad +
                       s.next_bisector_rad + s.next_half_angle_rad + s.distance_low_m +
                       s.distance_high_m);
}

bool finite(const BodySample& s) {
  return s.pillar.foot.allFinite() &&
         std::isfinite(s.time_s + s.weight + s.pillar.radius_m + s.pillar.height_m);
}

void validate(const OptimizationProblem& problem) {
  const std::size_t pieces = problem.durations_s.size();
  if (pieces < 2 || pieces > kMaxPieces)
    reject(std::to_string(pieces) + " pieces, expected 2 to " + std::to_string(kMaxPieces));
  if (pieces != kPiecesPerPolytope * problem.corridor.size())
    reject(std::to_string(pieces) + " durations for " + std::to_string(problem.corridor.size()) +
           " polytopes, expected " + std::to_string(kPiecesPerPolytope) + " each");
  if (problem.inner_waypoints.size() + 1 != pieces)
    reject(std::to_string(problem.inner_waypoints.size()) + " inner waypoints for " +
           std::to_string(pieces) + " pieces, expected one fewer");
  for (const double duration_s : problem.durations_s)
    if (!std::isfinite(duration_s) || duration_s <= 0.0) reject("a duration is not positive");
  for (const Vec3& waypoint : problem.inner_waypoints)
    if (!waypoint.allFinite()) reject("a waypoint is not finite");
  if (!finite(problem.start) || !finite(problem.goal)) reject("start or goal is not finite");
  for (const TargetSample& sample : problem.samples)
    if (!finite(sample) || sample.time_s < 0.0 || sample.time_s > problem.min_total_duration_s)
      reject("a sample is not finite or not within min_total_duration_s");
  for (const BodySample& body : problem.bodies)
    if (!finite(body) || body.time_s < 0.0 || body.time_s > problem.min_total_duration_s)
      reject("a body is not finite or not within min_total_duration_s");
}

OptimizationStatus status_of(LbfgsStatus status) {
  switch (status) {
    case LbfgsStatus::kConverged:
      return OptimizationStatus::kConverged;
    case LbfgsStatus::kCountReached:
      return OptimizationStatus::kCountReached;
    case LbfgsStatus::kNotFinite:
      break;
  }
  return OptimizationStatus::kNotFinite;
}

bool within(const FlightLimits& limits, const std::vector<QuinticPiece>& pieces) {
  return peak_norm(pieces, 1).value <= limits.speed_max_m_s &&
         peak_norm(pieces, 2).value <= limits.acceleration_max_m_s2;
}

void take_pieces(const Minco& minco, std::vector<QuinticPiece>& pieces) {
  pieces.clear();
  for (int i = 0; i < minco.pieces; ++i) pieces.push_back(piece_of(minco, i));
}

}  // namespace

struct OptimizerState::Workspace {
  TrajectoryCost cost;
  LbfgsState lbfgs;
  Variables x;
  OptimizationResult result;
};

OptimizerState::OptimizerState() : workspace_(std::make_unique<Workspace>()) {}
OptimizerState::~OptimizerState() = default;
OptimizerState::OptimizerState(OptimizerState&&) noexcept = default;
OptimizerState& OptimizerState::operator=(OptimizerState&&) noexcept = default;

const OptimizationResult& optimize_trajectory(OptimizerState& state,
                                              const OptimizationProblem& problem,
                                              const OptimizerParams& params) {
  validate(problem);
  auto& [cost, lbfgs, x, result] = state.workspace();
  cost.prepare(problem, params);
  x = cost.first_guess();
  const LbfgsReport report = minimize(
      lbfgs, cost, x, {params.relative_decrease, params.iterations_max, params.evaluations_max});
  result.status = status_of(report.status);
  result.iterations = report.iterations;
  result.evaluations = report.evaluations;
  result.initial_cost = report.initial_cost;
  result.cost = report.cost;
  result.slowdowns = 0;
  result.pieces.clear();
  result.pieces.reserve(kMaxPieces);
  if (result.status == OptimizationStatus::kNotFinite) return result;
  cost.set_trajectory(x);
  take_pieces(cost.minco(), result.pieces);
  // Penalties are soft: what still exceeds a limit flies the same waypoints slower.
  while (result.slowdowns < kSlowdownsMax && !within(problem.limits, result.pieces)) {
    ++result.slowdowns;
    cost.slow_down(kSlowdown);
    take_pieces(cost.minco(), result.pieces);
  }
  return result;
}

ParamRows rows(OptimizerParams& p) {
  return {
      {"time_weight", &p.time_weight, "1/s", 0.0, 1e6, "cost of a second (rho)"},
      {"corridor_weight", &p.corridor_weight, "1/m3", 0.0, 1e9, "of leaving the corridor"},
      {"speed_weight", &p.speed_weight, "s6/m6", 0.0, 1e9, "of speed above the limit"},
      {"acceleration_weight", &p.acceleration_weight, "s12/m6", 0.0, 1e9,
       "of acceleration above the limit"},
      {"visibility_weight", &p.visibility_weight, "", 0.0, 1e9,
       "of leaving the visible region at its time"},
      {"next_visibility_weight", &p.next_visibility_weight, "", 0.0, 1e9,
       "of being outside the next visible region"},
      {"distance_weight", &p.distance_weight, "1/m3", 0.0, 1e9, "of leaving the distance band"},
      {"height_weight", &p.height_weight, "1/m3", 0.0, 1e9, "of leaving the height band"},
      {"gap_weight", &p.gap_weight, "1/m3", 0.0, 1e9,
       "of coming nearer than gap_wanted_m to somebody who moves"},
      {"limit_fraction", &p.limit_fraction, "", 0.1, 1.0,
       "where the speed and acceleration penalties begin, of the limits"},
      {"corridor_margin_m", &p.corridor_margin_m, "m", 0.0, 1.0,
       "penalties begin this far inside the corridor"},
      {"relative_decrease", &p.relative_decrease, "", 0.0, 1.0,
       "stop when the cost decreases less over three iterations"},
      {"iterations_max", &p.iterations_max, "", 1.0, 10000.0, "most iterations"},
      {"evaluations_max", &p.evaluations_max, "", 1.0, 10000.0, "most evaluations"},
  };
}

}  // namespace foretrack
