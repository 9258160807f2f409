// SPDX-License-Identifier: Apache-2.0
#include "core/planning/attempts.hpp"

#include <algorithm>
#include <limits>

#include "core/planning/motion/stop_tail.hpp"

namespace foretrack {
namespace {

constexpr double kRetrySlowdown = 1.4;  // of the first guess's times in the second attempt
constexpr double kFirm = 10.0;          // of the hard limits' weights from the second attempt on
constexpr double kSoft = 50.0;          // by which sight and distance weigh less in the third
constexpr double kDistanceStep_s = 0.1;

OptimizerParams firmer(OptimizerParams p) {
  p.corridor_weight *= kFirm;
  p.speed_weight *= kFirm;
  p.acceleration_weight *= kFirm;
  return p;
}

OptimizerParams softer(OptimizerParams p) {
  p.visibility_weight /= kSoft;
  p.next_visibility_weight /= kSoft;
  p.distance_weight /= kSoft;
  return p;
}

// Slower, and ending at rest.
void make_careful(OptimizationProblem& problem) {
  for (double& duration_s : problem.durations_s) duration_s *= kRetrySlowdown;
  problem.goal.velocity.setZero();
}

void append_tail(PlannedTrajectory& trajectory, const FlightLimits& limits) {
  trajectory.tail_start_s = trajectory.duration_s();
  const QuinticPiece& last = trajectory.pieces.back();
  const double end_s = last.duration_s;
  const BoundaryState end{last.position(end_s), last.velocity(end_s), last.acceleration(end_s)};
  trajectory.pieces.push_back(make_stop_tail(end, limits).piece);
}

void aim(PlanningState& s, const PlanTask& task, PlannedTrajectory& trajectory) {
  const double lost_s = task.input.now_s - s.lost_since_s;
  if (task.lost && lost_s > task.params.view.search_look_s)
    sweep_camera(task.start, s.search_turn, task.params, s.aim, trajectory);
  else
    aim_camera(task.start, s.expected, task.params, s.aim, trajectory);
}

PlanReason attempt(PlanningState& s, const PlanTask& task, const std::optional<QuinticPiece>& first,
                   const OptimizerParams& optimizer, StageClock& clock) {
  auto& [trajectory, diagnostics] = s.next_result();
  const OptimizationResult& optimum = optimize_trajectory(s.optimizer, s.problem, optimizer);
  ++diagnostics.attempts;
  diagnostics.iterations += optimum.iterations;
  diagnostics.evaluations += optimum.evaluations;
  diagnostics.cost = optimum.cost;
  clock.lap(PlanStage::kOptimization);
  if (optimum.status == OptimizationStatus::kNotFinite) return PlanReason::kNotConverged;
  trajectory.pieces.clear();
  if (first) trajectory.pieces.push_back(*first);
  trajectory.pieces.insert(trajectory.pieces.end(), optimum.pieces.begin(), optimum.pieces.end());
  append_tail(trajectory, task.limits);
  aim(s, task, trajectory);
  const PlanReason reason = check_candidate(s, task);
  clock.lap(PlanStage::kCheck);
  return reason;
}

double least_target_distance_m(const PlannedTrajectory& trajectory, double from_s,
                               const ExpectedPath& path, const HorizonParams& horizon) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double t_s = 0.0; t_s <= horizon.horizon_s; t_s += kDistanceStep_s)
    least_m = std::min(least_m, distance_xy(trajectory.position(from_s + t_s), path.position(t_s)));
  return least_m;
}

// The target comes too near whatever is planned: rather away from it than on as before.
bool retreats(PlanningState& s, const PlanTask& task) {
  const CheckInputs inputs{*task.input.map, task.start.state, task.start.yaw};
  const PlannedTrajectory &candidate = s.next_result().trajectory,
                          &flown = s.flown_result().trajectory;
  if (!check_trajectory(candidate, inputs, task.limits, task.params.check).ok()) return false;
  if (!task.start.on_flown) return true;
  const ExpectedPath& path = s.expected.paths[0];
  return least_target_distance_m(candidate, 0.0, path, task.params.horizon) >
         least_target_distance_m(flown, task.start.time_s - flown.start_s, path,
                                 task.params.horizon);
}

}  // namespace

PlanReason attempt_all(PlanningState& s, const PlanTask& task,
                       const std::optional<QuinticPiece>& first, StageClock& clock) {
  const OptimizerParams& normal = task.params.optimizer;
  const PlanReason reason = attempt(s, task, first, normal, clock);
  if (reason == PlanReason::kOk) return reason;
  make_careful(s.problem);
  for (const OptimizerParams& careful : {firmer(normal), softer(firmer(normal))}) {
    const PlanReason again = attempt(s, task, first, careful, clock);
    if (again == PlanReason::kOk) return again;
    if (again == PlanReason::kTooNearTarget && retreats(s, task)) return PlanReason::kOk;
  }
  return reason;
}

PlanReason check_candidate(PlanningState& s, const PlanTask& task) {
  auto& [trajectory, diagnostics] = s.next_result();
  trajectory.start_s = task.start.time_s;
  CheckInputs inputs{*task.input.map, task.start.state, task.start.yaw};
  if (!task.lost && s.belief.count > 0) inputs.target_path = &s.belief.paths[0];
  inputs.target_stamp_s = s.belief.stamp_s;
  diagnostics.check = check_trajectory(trajectory, inputs, task.limits, task.params.check);
  return diagnostics.check.reason;
}

}  // namespace foretrack
