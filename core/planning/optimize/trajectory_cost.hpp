// SPDX-License-Identifier: Apache-2.0
// The cost of a trajectory over inner waypoints and durations (paper §V.C), for the optimiser.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "core/planning/optimize/duration_map.hpp"
#include "core/planning/optimize/lbfgs.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"
#include "core/planning/optimize/penalties.hpp"

namespace foretrack {

/// J(q, T) = ∫‖jerk‖² + ρT + penalties. Variables: the inner positions (x, y, z each), then those
/// of DurationMap. prepare() keeps a pointer to the problem.
class TrajectoryCost : public CostFunction {
 public:
  void prepare(const OptimizationProblem& problem, const OptimizerParams& params);
  const Variables& first_guess() const { return first_guess_; }
  /// Waypoints and durations from variables, and the trajectory through them.
  void set_trajectory(const Variables& x);
  /// Multiplies all durations of the present trajectory.
  void slow_down(double factor);
  const Minco& minco() const { return minco_; }

  double evaluate(const Variables& x, Variables& gradient) override;
  /// The inverse of the smoothness' Hessian at the first guess: fine waves of the waypoints are
  /// stiff, T⁻⁵, long ones soft; without this the conditioning is that of the sixth derivative.
  void precondition(Variables& direction) const override;

 private:
  struct PreparedSample {
    const TargetSample* sample;
    Sector region, next_region;
  };
  void set_first_guess();
  /// The minimum of the smoothness and the squared distance to the given waypoints.
  void smooth_first_guess();
  void add_sample(const PreparedSample& prepared, const Vec3& p, PointPenalty& sum) const;
  double add_points();
  /// What shifts of the local times by earlier durations cost, summed over each
  /// piece.
  void add_shifts(const std::array<double, kMaxPieces>& shifts);

  const OptimizationProblem* problem_ = nullptr;
  OptimizerParams params_;
  PieceWeights piece_weights_;
  DurationMap duration_map_;
  std::vector<PreparedSample> samples_;  // by time
  Variables first_guess_;
  Minco minco_;
  MincoGradient gradient_;
  WaypointMatrix hessian_;
  Eigen::LLT<WaypointMatrix> metric_;
};

}  // namespace foretrack
