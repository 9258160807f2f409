// SPDX-License-Identifier: Apache-2.0
// The intention-aware spatial-temporal optimisation (paper §V.B, §V.C).
#pragma once

#include <memory>
#include <vector>

#include "core/planning/motion/flight_limits.hpp"
#include "core/planning/optimize/penalties.hpp"

namespace foretrack {

/// Trajectory pieces a polytope (paper: K).
inline constexpr int kPiecesPerPolytope = 2;
inline constexpr int kPolytopesMax = kMaxPieces / kPiecesPerPolytope;

/// One z_k of one intention path. Regions are sectors in the plane, distances are horizontal.
struct TargetSample {
  double time_s = 0.0;  // t_k after the trajectory's start, at most min_total_duration_s
  double weight = 1.0;  // probability of the path × discount with time
  Vec3 target_enu_m = Vec3::Zero();
  bool has_region = false;      // V̂_k: the visible region shrunk by the intention's margins
  double bisector_rad = 0.0;    // ξ̂_k
  double half_angle_rad = 0.0;  // θ̂_k
  bool has_next = false;        // V_{k+1} as seen from z_{k+1}
  Vec3 next_target_enu_m = Vec3::Zero();
  double next_bisector_rad = 0.0;
  double next_half_angle_rad = 0.0;
  double distance_low_m = 1.5;   // d̂_l
  double distance_high_m = 2.5;  // d_u
};

/// Somebody who moves, expected at one place at one time.
struct BodySample {
  double time_s = 0.0;  // after the trajectory's start
  double weight = 1.0;  // probability of the course × discount with time
  Pillar pillar;
};

/// What a trajectory is to satisfy: its ends, its corridor, the target's samples.
struct OptimizationProblem {
  BoundaryState start;
  BoundaryState goal;
  std::vector<Polytope> corridor;     // M_F polytopes for the vehicle's centre; neighbours overlap
  std::vector<Vec3> inner_waypoints;  // first guess, K · M_F − 1
  std::vector<double> durations_s;    // first guess, K · M_F
  std::vector<TargetSample> samples;
  std::vector<BodySample> bodies;      // in the order of their times
  double hull_radius_m = 0.25;         // of the vehicle's ball
  double gap_wanted_m = 0.9;           // to each body
  double min_total_duration_s = 3.0;   // at least the prediction horizon
  double height_above_target_m = 0.5;  // desired, of the vehicle above z_k
  double height_band_m = 0.3;          // deviation that costs nothing
  FlightLimits limits;
};

/// Weights of the cost, and bounds of the work.
struct OptimizerParams {
  double time_weight = 20.0;              ///< cost of a second (rho)
  double corridor_weight = 4.0e6;         ///< of leaving the corridor
  double speed_weight = 4.0e3;            ///< of speed above the limit
  double acceleration_weight = 4.0e2;     ///< of acceleration above the limit
  double visibility_weight = 4.0e5;       ///< of leaving the visible region at its time
  double next_visibility_weight = 2.0e5;  ///< of being outside the next visible region
  double distance_weight = 1.0e5;         ///< of leaving the distance band
  double height_weight = 1.0e3;           ///< of leaving the height band
  double gap_weight = 4.0e5;  ///< of coming nearer than gap_wanted_m to somebody who moves
  /// where the speed and acceleration penalties begin, of the limits
  double limit_fraction = 0.93;
  double corridor_margin_m = 0.03;    ///< penalties begin this far inside the corridor
  double relative_decrease = 3.0e-4;  ///< stop when the cost decreases less over three iterations
  int iterations_max = 60;            ///< most iterations
  int evaluations_max = 90;           ///< most evaluations
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(OptimizerParams& params);

/// Whether there is a trajectory.
enum class OptimizationStatus {
  kConverged,     // the relative decrease fell below the parameter
  kCountReached,  // iterations or evaluations used up; the result is the best found
  kNotFinite,     // the problem has no finite cost at its first guess; no pieces
};

/// The trajectory, and how much work it was.
struct OptimizationResult {
  OptimizationStatus status = OptimizationStatus::kNotFinite;
  std::vector<QuinticPiece> pieces;
  int iterations = 0;
  int evaluations = 0;
  int slowdowns = 0;  // how often it was stretched in time afterwards to keep the limits
  double initial_cost = 0.0;
  double cost = 0.0;
};

/// Owned by the caller and reused: nothing is allocated after the first call.
class OptimizerState {
 public:
  OptimizerState();
  ~OptimizerState();
  OptimizerState(OptimizerState&&) noexcept;
  OptimizerState& operator=(OptimizerState&&) noexcept;

  struct Workspace;
  Workspace& workspace() { return *workspace_; }

 private:
  std::unique_ptr<Workspace> workspace_;
};

/// Minimises ∫‖jerk‖² + ρT and the penalties over inner waypoints and durations, which together
/// last at least min_total_duration_s. Penalties are soft: check_trajectory decides whether the
/// result may be flown. The result lives in `state` until the next call.
/// Throws std::invalid_argument if counts do not fit each other, a duration is not positive, a
/// number is not finite, or a sample lies beyond min_total_duration_s.
const OptimizationResult& optimize_trajectory(OptimizerState& state,
                                              const OptimizationProblem& problem,
                                              const OptimizerParams& params);

}  // namespace foretrack
