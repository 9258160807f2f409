// SPDX-License-Identifier: Apache-2.0
#include "core/planning/publish_plan.hpp"

namespace foretrack {
namespace {

void fill_views(PlanningState& s, double begin_s, double step_s, PlannedTrajectory& t) {
  resize_polytopes(s.corridor, t.corridor, s.problem.corridor.size());
  for (std::size_t i = 0; i < t.corridor.size(); ++i)
    t.corridor[i].planes.assign(s.problem.corridor[i].planes.begin(),
                                s.problem.corridor[i].planes.end());
  t.visible_regions.clear();
  const auto& views = s.ahead.views[0];
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (!views[k].seen) continue;
    VisibleRegion region;
    region.time_s = begin_s + step_s * static_cast<double>(k + 1);
    region.target_enu_m = s.expected.paths[0].position(region.time_s);
    region.bisector_rad = views[k].shrunk.bisector_rad;
    region.half_angle_rad = views[k].shrunk.half_angle_rad;
    region.waypoint_enu_m = s.ahead.way.points[s.ahead.way.arrival[k]];
    t.visible_regions.push_back(region);
  }
}

}  // namespace

const PlanResult& publish(PlanningState& s, const PlanTask& task, double way_begin_s,
                          const StageClock& clock) {
  auto& [trajectory, diagnostics] = s.next_result();
  trajectory.id = ++s.last_id;
  trajectory.stamp_s = task.lost ? s.belief.stamp_s : task.input.target.stamp_s;
  trajectory.status = task.lost ? PlanStatus::kSearch : PlanStatus::kFresh;
  trajectory.reason = task.lost ? PlanReason::kTargetLost : diagnostics.check.reason;
  fill_views(s, way_begin_s, task.params.horizon.step_s, trajectory);
  count_work(s, clock, diagnostics);
  s.flown = 1 - s.flown;
  s.flown_through = Passable::kSeenFree;
  return s.flown_result();
}

void count_work(const PlanningState& s, const StageClock& clock, PlanDiagnostics& d) {
  d.expansions = s.ahead.search.expansions;
  d.samples = static_cast<int>(s.problem.samples.size());
  d.polytopes = static_cast<int>(s.problem.corridor.size());
  d.planes = 0;
  for (const Polytope& polytope : s.problem.corridor)
    d.planes += static_cast<int>(polytope.planes.size());
  d.stage_ms = clock.stage_ms();
}

}  // namespace foretrack
