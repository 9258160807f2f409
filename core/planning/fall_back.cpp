// SPDX-License-Identifier: Apache-2.0
#include "core/planning/fall_back.hpp"

#include <limits>
#include <utility>

#include "core/planning/attempts.hpp"
#include "core/planning/evade.hpp"
#include "core/planning/motion/clear_rest.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/publish_plan.hpp"

namespace foretrack {
namespace {

constexpr double kStands_m_s = 0.02;
constexpr double kBetter = 0.8;  // of a cost: what is flown is not left for little
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// Of the rest of what is flown; none if it is not clear in this map any more.
std::optional<BodyGaps> gaps_of_rest(const PlanningState& s, const PlanTask& task,
                                     const PlannedTrajectory& flown, double t_s) {
  if (!task.start.on_flown) return {};
  if (!rest_is_clear(*task.input.map, flown, t_s, kept_clearance_m(task), s.flown_through))
    return {};
  return measure_gaps(flown, t_s, s.courses, task.limits, task.params.body);
}

// The next candidate is not on the searched way: there is nothing of it to be
// drawn.
void forget_way(PlanningState& s) {
  s.ahead.views[0].clear();
  resize_polytopes(s.corridor, s.problem.corridor, 0);
}

const PlanResult& brake(PlanningState& s, const PlanTask& task, PlanReason reason,
                        StageClock& clock) {
  try_stop(s, task, clock);
  publish(s, task, 0.0, clock);
  PlannedTrajectory& braking = s.flown_result().trajectory;
  braking.status = PlanStatus::kHold;
  braking.reason = reason;
  return s.flown_result();
}

// Makes the best way out the next candidate, if it costs less: through seen space, or, where
// whatever else there is comes very near somebody, through what nobody has seen.
std::optional<Passable> evade_if_better(PlanningState& s, const PlanTask& task, double cost_to_beat,
                                        double least_gap_m) {
  std::optional<Passable> taken;
  for (const Passable passable : {Passable::kSeenFree, Passable::kNotOccupied}) {
    const bool unseen = passable == Passable::kNotOccupied;
    if (unseen && least_gap_m >= task.params.body.unseen_gap_m) break;
    const std::optional<CheckResult> evasion = evade(s, task, cost_to_beat, passable);
    if (!evasion) continue;
    std::swap(s.next_result().trajectory, s.evading);
    s.next_result().diagnostics.check = *evasion;
    forget_way(s);
    taken = passable;
    cost_to_beat = kBetter * evasion->gaps.cost;
    least_gap_m = evasion->gaps.least_m;
  }
  return taken;
}

// Whether the shortest stop is clear of everybody who moves. Works in state.evading.
bool stop_keeps_gaps(PlanningState& s, const PlanTask& task) {
  s.evading.start_s = task.start.time_s;
  s.evading.pieces.assign(1, make_stop_tail(task.start.state, task.limits).piece);
  return measure_gaps(s.evading, 0.0, s.courses, task.limits, task.params.body).ok;
}

}  // namespace

PlanReason try_stop(PlanningState& s, const PlanTask& task, StageClock& clock) {
  PlannedTrajectory& trajectory = s.next_result().trajectory;
  trajectory.pieces.assign(1, make_stop_tail(task.start.state, task.limits).piece);
  trajectory.tail_start_s = 0.0;
  hold_camera(task.start, task.params, s.aim, trajectory);
  forget_way(s);
  const PlanReason reason = check_candidate(s, task);
  clock.lap(PlanStage::kCheck);
  return reason;
}

const PlanResult& fall_back(PlanningState& s, const PlanTask& task, PlanReason reason,
                            StageClock& clock) {
  const PlannedTrajectory& flown = s.flown_result().trajectory;
  const double t_s = task.start.time_s - flown.start_s;
  const std::optional<BodyGaps> kept = gaps_of_rest(s, task, flown, t_s);
  if (kept && kept->ok) return keep(s, t_s, reason, clock);
  if (!kept && stop_keeps_gaps(s, task)) return brake(s, task, reason, clock);

  // Somebody comes too near: the best that is possible.
  double cost_to_beat = kept ? kBetter * kept->cost : kInfinity;
  const CheckResult& candidate = s.next_result().diagnostics.check;
  const bool only_too_near = candidate.reason == PlanReason::kTooNearTarget;
  const bool takes_candidate = only_too_near && candidate.gaps.cost < cost_to_beat;
  if (takes_candidate) cost_to_beat = kBetter * candidate.gaps.cost;
  const double least_m = takes_candidate ? candidate.gaps.least_m
                         : kept          ? kept->least_m
                                         : -kInfinity;
  const std::optional<Passable> evades = evade_if_better(s, task, cost_to_beat, least_m);
  clock.lap(PlanStage::kCheck);
  if (evades || takes_candidate) {
    publish(s, task, 0.0, clock);
    s.flown_through = evades.value_or(Passable::kSeenFree);
    s.flown_result().trajectory.reason = reason;
    return s.flown_result();
  }
  if (kept) return keep(s, t_s, reason, clock);
  return brake(s, task, reason, clock);
}

const PlanResult& refuse(PlanningState& s) {
  auto& [trajectory, diagnostics] = s.flown_result();
  diagnostics = {};
  if (!trajectory.pieces.empty()) trajectory.status = PlanStatus::kKept;
  trajectory.reason = PlanReason::kStaleInput;
  return s.flown_result();
}

}  // namespace foretrack
