// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan.hpp"

#include <algorithm>

#include "core/planning/expect_target.hpp"
#include "core/planning/fall_back.hpp"
#include "core/planning/follow_target.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/publish_plan.hpp"
#include "core/planning/search_target.hpp"
#include "core/planning/see/expect_bodies.hpp"

namespace foretrack {
namespace {

bool is_finite(const PlanInput& in) {
  return std::isfinite(in.now_s) && in.vehicle.position_enu_m.allFinite() &&
         in.vehicle.velocity_enu_m_s.allFinite() && in.vehicle.q_world_body.coeffs().allFinite() &&
         in.vehicle.angular_velocity_body_rad_s.allFinite();
}

constexpr double kSlower_m_s = 0.3;  // that a vehicle may be too fast before it brakes at once
constexpr double kWaits_m_s = 0.02;

// The person whom a search does not see may be near. Who is a little too fast gets no faster.
FlightLimits limits_of_search(const PlanningState& state, const PlanStart& start,
                              const PlanningParams& params) {
  FlightLimits limits = params.limits;
  limits.speed_max_m_s =
      std::min(limits.speed_max_m_s,
               std::max(search_speed_m_s(state.search, params), start.state.velocity.norm()));
  return limits;
}

bool is_too_fast(const PlanningState& state, const PlanStart& start, const PlanningParams& params) {
  return start.state.velocity.norm() > search_speed_m_s(state.search, params) + kSlower_m_s;
}

// Stops if it must, stands, and looks where the target is or most likely is.
const PlanResult& stand_by(PlanningState& state, const PlanTask& task, StageClock& clock) {
  const PlanReason reason = wait_for_target(state, task, clock);
  if (reason != PlanReason::kOk) return fall_back(state, task, reason, clock);
  publish(state, task, 0.0, clock);
  state.flown_result().trajectory.status = PlanStatus::kHold;
  return state.flown_result();
}

// The search is over.
const PlanResult& wait(PlanningState& state, const PlanTask& task, StageClock& clock) {
  const bool stands = task.start.state.velocity.norm() < kWaits_m_s;
  return stands ? stand_by(state, task, clock)
                : fall_back(state, task, PlanReason::kTargetLost, clock);
}

void learn_deviation(PlanningState& state, const PlanInput& input) {
  const PlannedTrajectory& flown = state.flown_result().trajectory;
  const double t_s = input.vehicle.stamp_s - flown.start_s;
  if (!input.flies_plans || flown.pieces.empty() || t_s < 0.0) return;
  state.deviation.add(flown, t_s, input.vehicle.position_enu_m);
}

}  // namespace

const PlanResult& plan(PlanningState& state, const PlanInput& given,
                       const PlanningParams& given_params) {
  if (!state.reserved) reserve(state);
  StageClock clock(state.clock_s);
  state.next_result().diagnostics = {};
  const PlanInput input = without_stale(given, given_params.horizon);
  const bool knows_where_it_is =
      input.now_s - input.vehicle.stamp_s <= given_params.horizon.vehicle_stale_s;
  if (!is_finite(input) || input.map == nullptr || !knows_where_it_is) return refuse(state);

  learn_deviation(state, input);
  const PlanningParams& params = frame_target(state.framing, input, given_params);

  // Where the trajectory begins, whom it follows, who else moves, how fast it
  // may be.
  const PlanStart start = choose_start(state.flown_result().trajectory, input, params);
  const PlanReason expected = expect_target(state, input, params.horizon);
  const bool lost = state.lost(), waits = input.waits && expected == PlanReason::kOk;
  const bool searches = lost && !waits && expected == PlanReason::kOk;
  if (lost) search_on(state, input, start, searches, params);
  expect_bodies(input, expected == PlanReason::kOk && !lost ? &state.belief : nullptr, params.body,
                state.courses);
  if (lost) add_near_belief(state.search, input.now_s, params.body, state.courses);
  const bool slows_down = searches && is_too_fast(state, start, params);
  const PlanTask task{
      input, params,
      searches && !slows_down ? limits_of_search(state, start, params) : params.limits, start,
      lost};
  if (waits) return stand_by(state, task, clock);
  if (expected == PlanReason::kTargetLost) return wait(state, task, clock);
  if (expected != PlanReason::kOk) return fall_back(state, task, expected, clock);
  if (slows_down) {
    const PlanReason stop = try_stop(state, task, clock);
    return stop == PlanReason::kOk ? publish(state, task, 0.0, clock)
                                   : fall_back(state, task, stop, clock);
  }
  if (searches) {
    const PlanReason reason = search_target(state, task, clock);
    return reason == PlanReason::kOk ? publish(state, task, 0.0, clock)
                                     : fall_back(state, task, reason, clock);
  }

  // The paper's §V, and the check.
  const PlanReason reason = follow_target(state, task, {}, clock);
  if (reason == PlanReason::kOk) return publish(state, task, 0.0, clock);

  // The motion so far may leave no room to turn into the way: then it comes to rest before.
  if (start.on_flown && reason != PlanReason::kTooNearTarget) {
    const QuinticPiece stop = make_stop_tail(start.state, task.limits).piece;
    if (follow_target(state, task, stop, clock) == PlanReason::kOk)
      return publish(state, task, stop.duration_s, clock);
  }
  return fall_back(state, task, reason, clock);
}

}  // namespace foretrack
