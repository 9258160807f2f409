// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search_target.hpp"

#include "core/planning/attempts.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/optimize/assemble_problem.hpp"

namespace foretrack {
namespace {

constexpr double kGazeFar_m = 4.0;       // at which the camera is pointed
constexpr double kOffChosenWay_m = 1.5;  // farther from its way, the vehicle waits for another one
constexpr double kSearchCoast_s = 0.2;
constexpr double kWait_s = 1.0;

// The camera is aimed at a person who would stand there.
void look_at(PlanningState& s, const PlanTask& task, const Vec2& place) {
  TargetBelief& watched = s.watched;
  watched.stamp_s = task.start.time_s;
  watched.count = 1;
  PredictedPath& path = watched.paths[0];
  path.probability = 1.0;
  path.states.resize(1);
  path.states[0] = PredictedState{};
  path.states[0].position_enu_m << place, s.search.torso_m;
  align(watched, task.start.time_s, task.params.horizon, s.expected);
}

FlightSurface surface_of(const PlanningState& s, const PlanTask& task) {
  const Vec3& start = task.start.state.position;
  return {start.head<2>(), start.z(), s.search.torso_m + task.params.place.height_above_target_m};
}

// On from the place of the chosen way that is nearest.
void rest_of_way(PlanningState& s, const PlanTask& task, const FlightSurface& surface) {
  const Vec3& start = task.start.state.position;
  const std::vector<Vec2>& way = s.search.way;
  WaypointPath& out = s.ahead.way;
  out.points.assign(1, start);
  out.arrival.clear();
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < way.size(); ++i)
    if ((way[i] - start.head<2>()).squaredNorm() < (way[nearest] - start.head<2>()).squaredNorm())
      nearest = i;
  const Vec3 coast = start + kSearchCoast_s * task.start.state.velocity;
  if (!way.empty() && (way[nearest] - start.head<2>()).norm() < kOffChosenWay_m)
    for (std::size_t i = nearest + 1; i < way.size(); ++i)
      if ((way[i] - coast.head<2>()).norm() > task.input.map->resolution_m)
        out.points.push_back(surface.at(way[i]));
  const auto steps = s.expected.paths[0].positions_enu_m.size();
  out.arrival.assign(steps, static_cast<int>(out.points.size()) - 1);
}

}  // namespace

void search_on(PlanningState& s, const PlanInput& input, const PlanStart& start, bool flies,
               const PlanningParams& params) {
  const SearchStep step{input.now_s, input.vehicle, *input.map, start.state.position,
                        start.state.velocity};
  if (!s.search.active) begin_search(s.search, s.belief, step, params);
  s.search.waits = !flies;
  believe(s.search, step, params);
  if (flies) choose_viewpoint(s.search, step, params);
}

PlanReason search_target(PlanningState& s, const PlanTask& task, StageClock& clock) {
  const Vec2 from = task.start.state.position.head<2>();
  look_at(s, task, from + kGazeFar_m * direction_of(s.search.gaze_rad));
  const FlightSurface surface = surface_of(s, task);
  const SearchContext context{*task.input.map, surface,          task.params, task.limits, 0.0, 0.0,
                              &s.courses,      task.start.time_s};
  s.ahead.search.expansions = 0;
  s.ahead.views[0].clear();
  rest_of_way(s, task, surface);
  make_flight_path(context, s.ahead.way, task.start.state.velocity.norm(), s.path_workspace,
                   s.path);
  clock.lap(PlanStage::kPath);
  const bool clear = build_corridor(context, s.path, s.deviation, s.corridor, s.problem.corridor);
  guess_trajectory(context, s.path, task.start, s.expected, s.problem);
  s.problem.samples.clear();
  add_bodies(context, s.path, s.problem);
  clock.lap(PlanStage::kCorridor);
  const PlanReason reason = attempt_all(s, task, {}, clock);
  return reason != PlanReason::kOk && !clear ? PlanReason::kEmptyCorridor : reason;
}

PlanReason wait_for_target(PlanningState& s, const PlanTask& task, StageClock& clock) {
  const Vec2 from = task.start.state.position.head<2>();
  const Vec2 likeliest = s.search.likeliest_m - from;
  if (task.lost)
    look_at(s, task, from + kGazeFar_m * direction_of(yaw_of(likeliest)));
  else
    align(s.belief, task.start.time_s, task.params.horizon, s.expected);
  PlannedTrajectory& trajectory = s.next_result().trajectory;
  trajectory.pieces.assign(1, make_stop_tail(task.start.state, task.limits, kWait_s).piece);
  trajectory.tail_start_s = 0.0;
  s.ahead.views[0].clear();
  resize_polytopes(s.corridor, s.problem.corridor, 0);
  aim(s, task, trajectory);
  const PlanReason reason = check_candidate(s, task);
  clock.lap(PlanStage::kCheck);
  return reason;
}

}  // namespace foretrack
