// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/trajectory_cost.hpp"

#include <algorithm>
#include <limits>

namespace foretrack {
namespace {

/// Curvatures that the preconditioner assumes: of the penalties by a waypoint's coordinate, and of
/// the cost by a duration's variable. Found by measurement on the benchmark's problems.
constexpr double kPenaltyCurvature = 20.0;
constexpr double kDurationCurvature = 300.0;

constexpr double kNever_s = std::numeric_limits<double>::infinity();
constexpr double kSameTime_s = 1e-6;

std::span<const double> duration_part(const Variables& x, int pieces) {
  return {x.data() + 3 * (pieces - 1), static_cast<std::size_t>(pieces) + 1};
}
std::span<double> duration_part(Variables& x, int pieces) {
  return {x.data() + 3 * (pieces - 1), static_cast<std::size_t>(pieces) + 1};
}

}  // namespace

void TrajectoryCost::prepare(const OptimizationProblem& problem, const OptimizerParams& params) {
  problem_ = &problem;
  params_ = params;
  piece_weights_ = {params.corridor_weight,
                    params.speed_weight,
                    params.acceleration_weight,
                    params.corridor_margin_m,
                    params.limit_fraction * problem.limits.speed_max_m_s,
                    params.limit_fraction * problem.limits.acceleration_max_m_s2};
  duration_map_.min_total_s = problem.min_total_duration_s;
  samples_.clear();
  for (const TargetSample& s : problem.samples)
    samples_.push_back(
        {&s, make_sector(s.target_enu_m, s.bisector_rad, s.half_angle_rad),
         make_sector(s.next_target_enu_m, s.next_bisector_rad, s.next_half_angle_rad)});
  std::ranges::sort(samples_, {}, [](const PreparedSample& s) { return s.sample->time_s; });
  set_ends(minco_, problem.start, problem.goal, static_cast<int>(problem.durations_s.size()));
  set_first_guess();
  set_trajectory(first_guess_);
  jerk_hessian(minco_, hessian_);
  hessian_.diagonal().array() += kPenaltyCurvature;
  metric_.compute(hessian_);
  smooth_first_guess();
}

void TrajectoryCost::smooth_first_guess() {
  const int n = minco_.pieces;
  set_zero(gradient_, n);
  add_jerk_energy(minco_, gradient_);
  Variables step = Variables::Zero(first_guess_.size());
  for (int i = 0; i + 1 < n; ++i)
    step.segment<3>(3 * i) = -gradient_.junctions[i + 1].row(0).transpose();
  precondition(step);
  first_guess_ += step;
}

void TrajectoryCost::set_first_guess() {
  const int n = minco_.pieces;
  Variables& x = first_guess_;
  x.resize(4 * n - 2);
  for (int i = 0; i + 1 < n; ++i) x.segment<3>(3 * i) = problem_->inner_waypoints[i];
  duration_map_.to_variables(problem_->durations_s, duration_part(x, n));
}

void TrajectoryCost::set_trajectory(const Variables& x) {
  const int n = minco_.pieces;
  for (int i = 0; i + 1 < n; ++i) minco_.junctions[i + 1].row(0) = x.segment<3>(3 * i).transpose();
  duration_map_.to_durations(duration_part(x, n), {minco_.durations_s.data(), std::size_t(n)});
  solve(minco_);
}

void TrajectoryCost::slow_down(double factor) {
  for (int i = 0; i < minco_.pieces; ++i) minco_.durations_s[i] *= factor;
  solve(minco_);
}

double TrajectoryCost::evaluate(const Variables& x, Variables& gradient) {
  const int n = minco_.pieces;
  set_trajectory(x);
  set_zero(gradient_, n);
  double cost = 0.0;
  for (int i = 0; i < n; ++i) {
    const Polytope& polytope = problem_->corridor[i / kPiecesPerPolytope];
    cost += add_piece_penalties(minco_, i, polytope, piece_weights_, gradient_);
    cost += params_.time_weight * minco_.durations_s[i];
    gradient_.durations[i] += params_.time_weight;
  }
  cost += add_points();
  cost += add_jerk_energy(minco_, gradient_);
  propagate(minco_, gradient_);
  for (int i = 0; i + 1 < n; ++i)
    gradient.segment<3>(3 * i) = gradient_.junctions[i + 1].row(0).transpose();
  duration_map_.pull_back(duration_part(x, n), {gradient_.durations.data(), std::size_t(n)},
                          duration_part(gradient, n));
  return cost;
}

void TrajectoryCost::add_sample(const PreparedSample& prepared, const Vec3& p,
                                PointPenalty& sum) const {
  const TargetSample& s = *prepared.sample;
  if (s.has_region) add_visibility(p, prepared.region, s.weight * params_.visibility_weight, sum);
  if (s.has_next)
    add_visibility(p, prepared.next_region, s.weight * params_.next_visibility_weight, sum);
  add_distance_band(p, s.target_enu_m, s.distance_low_m, s.distance_high_m,
                    s.weight * params_.distance_weight, sum);
  add_height_band(p, s.target_enu_m.z() + problem_->height_above_target_m, problem_->height_band_m,
                  s.weight * params_.height_weight, sum);
}

/// The target's samples and the bodies of one time share one position.
double TrajectoryCost::add_points() {
  double cost = 0.0;
  std::array<double, kMaxPieces> shifts;  // ∂J by the local time's shift, summed over a piece
  std::fill_n(shifts.begin(), minco_.pieces, 0.0);
  PieceTime at;
  auto sample = samples_.begin();
  auto body = problem_->bodies.begin();
  const auto next_s = [&] {
    const double sample_s = sample != samples_.end() ? sample->sample->time_s : kNever_s;
    return body != problem_->bodies.end() ? std::min(sample_s, body->time_s) : sample_s;
  };
  for (double time_s = next_s(); time_s < kNever_s; time_s = next_s()) {
    advance(minco_, time_s, at);
    const Vec3 p = position_at(minco_, at);
    PointPenalty sum;
    const double end_s = time_s + kSameTime_s;
    for (; sample != samples_.end() && sample->sample->time_s <= end_s; ++sample)
      add_sample(*sample, p, sum);
    for (; body != problem_->bodies.end() && body->time_s <= end_s; ++body)
      add_gap(p, problem_->hull_radius_m, body->pillar, problem_->gap_wanted_m,
              body->weight * params_.gap_weight, sum);
    if (sum.value == 0.0) continue;
    cost += sum.value;
    shifts[at.piece] += add_position_gradient(minco_, at, sum.gradient, gradient_);
  }
  add_shifts(shifts);
  return cost;
}

void TrajectoryCost::add_shifts(const std::array<double, kMaxPieces>& shifts) {
  double later = 0.0;
  for (int i = minco_.pieces - 1; i >= 0; --i) {
    gradient_.durations[i] += later;
    later += shifts[i];
  }
}

void TrajectoryCost::precondition(Variables& direction) const {
  // Forward and back substitution by columns of the Cholesky factor, three axes at once.
  const int m = minco_.pieces - 1;
  const auto& L = metric_.matrixLLT();
  const auto at = [&](int i) { return Eigen::Map<Vec3>(direction.data() + 3 * i); };
  for (int j = 0; j < m; ++j) {
    const Vec3 x = at(j) / L(j, j);
    at(j) = x;
    for (int i = j + 1; i < m; ++i) at(i) -= L(i, j) * x;
  }
  for (int j = m - 1; j >= 0; --j) {
    Vec3 x = at(j);
    for (int i = j + 1; i < m; ++i) x -= L(i, j) * at(i);
    at(j) = x / L(j, j);
  }
  direction.tail(m + 2) *= 1.0 / kDurationCurvature;
}

}  // namespace foretrack
