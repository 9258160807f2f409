// SPDX-License-Identifier: Apache-2.0
#include "core/planning/fall_back.hpp"

#include "core/planning/attempts.hpp"
#include "core/planning/motion/clear_rest.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/publish_plan.hpp"

namespace foretrack {
namespace {

constexpr double kStands_m_s = 0.02;

// Half a cell less than a new trajectory needs: where the map has not changed, what passed the
// check must not be braked for because it is looked at from other points.
double kept_clearance_m(const PlanTask& task) {
  return task.params.check.vehicle_radius_m - 0.5 * task.input.map->resolution_m;
}

const PlanResult& keep(PlanningState& s, double t_s, PlanReason reason, const StageClock& clock) {
  auto& [trajectory, diagnostics] = s.flown_result();
  const bool stands =
      trajectory.velocity(t_s).norm() < kStands_m_s && t_s > trajectory.tail_start_s;
  trajectory.status = stands ? PlanStatus::kHold : PlanStatus::kKept;
  trajectory.reason = reason;
  diagnostics = s.next_result().diagnostics;
  count_work(s, clock, diagnostics);
  return s.flown_result();
}

}  // namespace

PlanReason try_stop(PlanningState& s, const PlanTask& task, StageClock& clock) {
  PlannedTrajectory& trajectory = s.next_result().trajectory;
  trajectory.pieces.assign(1, make_stop_tail(task.start.state, task.limits).piece);
  trajectory.tail_start_s = 0.0;
  hold_camera(task.start, task.params, s.aim, trajectory);
  s.ahead.views[0].clear();
  resize_polytopes(s.corridor, s.problem.corridor, 0);
  const PlanReason reason = check_candidate(s, task);
  clock.lap(PlanStage::kCheck);
  return reason;
}

const PlanResult& fall_back(PlanningState& s, const PlanTask& task, PlanReason reason,
                            StageClock& clock) {
  const PlannedTrajectory& flown = s.flown_result().trajectory;
  const double t_s = task.start.time_s - flown.start_s;
  if (task.start.on_flown && rest_is_clear(*task.input.map, flown, t_s, kept_clearance_m(task)))
    return keep(s, t_s, reason, clock);
  try_stop(s, task, clock);
  publish(s, task, 0.0, clock);
  PlanResult& braking = s.flown_result();
  braking.trajectory.status = PlanStatus::kHold;
  braking.trajectory.reason = reason;
  return braking;
}

const PlanResult& refuse(PlanningState& s) {
  auto& [trajectory, diagnostics] = s.flown_result();
  diagnostics = {};
  if (!trajectory.pieces.empty()) trajectory.status = PlanStatus::kKept;
  trajectory.reason = PlanReason::kStaleInput;
  return s.flown_result();
}

}  // namespace foretrack
