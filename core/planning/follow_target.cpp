// SPDX-License-Identifier: Apache-2.0
#include "core/planning/follow_target.hpp"

#include "core/planning/attempts.hpp"
#include "core/planning/optimize/assemble_problem.hpp"
#include "core/planning/see/target_samples.hpp"

namespace foretrack {
namespace {

// Π_dec.
double score_decelerate(const PlanTask& task) {
  const bool counts = task.input.intention != nullptr && task.params.horizon.intention_margins;
  return counts ? task.input.intention->margins.distance : 0.0;
}

// The ring d* is the middle of the band.
SearchContext search_context(const PlanTask& task, const FlightSurface& surface,
                             const BodyCourses& courses, double start_s,
                             const FramingState& framing) {
  const PlaceParams& place = task.params.place;
  const GridMap& map = *task.input.map;
  const double low_m = place.kept_low_m(score_decelerate(task));
  const double half_band_m = 0.5 * (place.kept_high_m() - low_m);
  const double tolerance_m =
      std::max(std::min(place.ring_tolerance_m, half_band_m), 0.5 * map.resolution_m);
  return {map,
          surface,
          task.params,
          task.limits,
          low_m + half_band_m,
          tolerance_m,
          &courses,
          start_s,
          framing.turns ? &framing.bearing : nullptr};
}

// Where the way begins: at the trajectory's start, or where the stop before it has come to rest.
PlanStart start_of_way(const PlanStart& start, const std::optional<QuinticPiece>& first) {
  if (!first) return start;
  PlanStart rest = start;
  rest.time_s += first->duration_s;
  rest.state = {first->position(first->duration_s), Vec3::Zero(), Vec3::Zero()};
  return rest;
}

// What hides the target may lie across the way at this level only, where
// neither the vehicle nor the target is: tries one other level in each replan,
// the one that was seen from last first.
void look_from_another_level(PlanningState& s, const PlanTask& task, const SearchContext& context,
                             const PlanStart& from, FlightSurface& surface, StageClock& clock) {
  const FlightSurface wanted = surface;
  const Vec3& start = from.state.position;
  const auto look = [&] {
    look_ahead(context, start, from.state.velocity, s.expected, task.input.intention, clock,
               s.ahead);
  };
  const std::optional<FlightSurface> other =
      other_flight_surface(*task.input.map, start, s.expected.paths[0].positions_enu_m.front(),
                           s.level_tried, task.params);
  if (other) {
    surface = *other;
    look();
    if (s.ahead.target_seen) return;
    surface = wanted;
    look();
  }
  s.level_tried = (s.level_tried + 1) % kOtherLevels;
}

}  // namespace

PlanReason follow_target(PlanningState& s, const PlanTask& task,
                         const std::optional<QuinticPiece>& first, StageClock& clock) {
  const GridMap& map = *task.input.map;
  const PlanStart from = start_of_way(task.start, first);
  align(s.belief, from.time_s, task.params.horizon, s.expected);
  const Vec3& z_1 = s.expected.paths[0].positions_enu_m.front();
  FlightSurface surface = choose_flight_surface(map, from.state.position, z_1, task.params);
  const SearchContext context = search_context(task, surface, s.courses, from.time_s, s.framing);

  // §V.A: places that see the target, and the visible regions around it.
  look_ahead(context, from.state.position, from.state.velocity, s.expected, task.input.intention,
             clock, s.ahead);
  if (!s.ahead.target_seen) look_from_another_level(s, task, context, from, surface, clock);
  make_flight_path(context, s.ahead.way, from.state.velocity.norm(), s.path_workspace, s.path);
  clock.lap(PlanStage::kPath);

  // §V.B: the corridor, the first guess, and what the optimiser is to keep.
  const bool clear = build_corridor(context, s.path, s.deviation, s.corridor, s.problem.corridor);
  guess_trajectory(context, s.path, from, s.expected, s.problem);
  make_samples(context, s.expected, s.ahead, s.path_workspace, from.state, score_decelerate(task),
               s.problem.samples);
  add_bodies(context, s.path, s.problem);
  if (first) align(s.belief, task.start.time_s, task.params.horizon, s.expected);
  clock.lap(PlanStage::kCorridor);

  // §V.C, and the check. A corridor that only touches an obstacle may still hold a way.
  const PlanReason reason = attempt_all(s, task, first, clock);
  return reason != PlanReason::kOk && !clear ? PlanReason::kEmptyCorridor : reason;
}

}  // namespace foretrack
