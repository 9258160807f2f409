// SPDX-License-Identifier: Apache-2.0
#include "core/planning/attempts.hpp"

#include "core/planning/motion/stop_tail.hpp"

namespace foretrack {
namespace {

constexpr double kRetrySlowdown = 1.4;  // of the first guess's times in the second attempt
constexpr double kFirm = 10.0;          // of the hard limits' weights from the second attempt on
constexpr double kSoft = 50.0;          // by which sight and distance weigh less in the third

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

}  // namespace

PlanReason attempt_all(PlanningState& s, const PlanTask& task,
                       const std::optional<QuinticPiece>& first, StageClock& clock) {
  const OptimizerParams& normal = task.params.optimizer;
  const PlanReason reason = attempt(s, task, first, normal, clock);
  if (reason == PlanReason::kOk) return reason;
  make_careful(s.problem);
  // Where somebody is too near, firmer limits give no more room: sight and distance must give way.
  // The same at once after a stop, as all this has been tried without it.
  if (reason != PlanReason::kTooNearTarget && !first &&
      attempt(s, task, first, firmer(normal), clock) == PlanReason::kOk)
    return PlanReason::kOk;
  return attempt(s, task, first, softer(firmer(normal)), clock) == PlanReason::kOk ? PlanReason::kOk
                                                                                   : reason;
}

void aim(PlanningState& s, const PlanTask& task, PlannedTrajectory& trajectory) {
  if (s.expected.count == 0)
    hold_camera(task.start, task.params, s.aim, trajectory);
  else
    aim_camera(task.start, s.expected, task.params, s.aim, trajectory);
}

PlanReason check_candidate(PlanningState& s, const PlanTask& task) {
  auto& [trajectory, diagnostics] = s.next_result();
  diagnostics.check = check(s, task, trajectory);
  return diagnostics.check.reason;
}

CheckResult check(const PlanningState& s, const PlanTask& task, PlannedTrajectory& trajectory,
                  Passable passable) {
  trajectory.start_s = task.start.time_s;
  const CheckInputs inputs{*task.input.map, task.start.state,  task.start.yaw,
                           &s.courses,      &task.params.body, passable};
  return check_trajectory(trajectory, inputs, task.limits, task.params.check);
}

}  // namespace foretrack
