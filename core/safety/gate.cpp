// SPDX-License-Identifier: Apache-2.0
#include "core/safety/gate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace foretrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Rung {
  SafetyMode mode;
  SafetyReason reason;
};

void take_command(GateState& s, const GateInput& in, const SafetyParams& p) {
  if (p.start_on_launch && !s.launched) s.mission.phase = MissionPhase::kTracking;
  s.launched = true;
  if (!in.command) return;
  s.last_command = *in.command;
  s.last_result = apply(*in.command, s.mission, in.now_s, {p.command_max_age_s, p.lease_s});
}

void start_next(GateState& s, double now_s) {
  if (!s.has_next || now_s < s.next.start_s - 1e-9) return;
  std::swap(s.flown, s.next);
  s.has_flown = true;
  s.has_next = false;
}

// A new plan waits until its start, so that the switch is where the planner made it continuous. The
// one that waits starts before a newer one takes its place: replans may come as often as they lead.
void take_plan(GateState& s, const GateInput& in) {
  start_next(s, in.now_s);
  if (in.plan) {
    s.last_plan_s = in.now_s;
    const bool is_new = !in.plan->pieces.empty() && !(s.has_flown && in.plan->id == s.flown.id) &&
                        !(s.has_next && in.plan->id == s.next.id);
    if (is_new) {
      s.next = *in.plan;
      s.has_next = true;
    }
  }
  start_next(s, in.now_s);
}

Rung tracking_rung(const GateState& s, const GateInput& in, const GateResult& r,
                   const SafetyParams& p) {
  const bool fresh = s.last_plan_s >= 0.0 && in.now_s - s.last_plan_s <= p.plan_fresh_s;
  if (!s.has_flown) return {SafetyMode::kHover, SafetyReason::kNoPlanYet};
  if (r.deviation_m > p.max_deviation_m) return {SafetyMode::kBrake, SafetyReason::kOffTrajectory};
  const bool ended = in.now_s - s.flown.start_s > s.flown.duration_s();
  if (ended)
    return {SafetyMode::kHover, fresh ? SafetyReason::kPlanHolds : SafetyReason::kPlanEnded};
  return fresh ? Rung{SafetyMode::kTrack, SafetyReason::kNone}
               : Rung{SafetyMode::kCoast, SafetyReason::kPlanStale};
}

Rung choose_rung(GateState& s, const GateInput& in, const GateResult& r, const SafetyParams& p) {
  if (in.now_s - in.vehicle.stamp_s > p.vehicle_stale_s)
    return {SafetyMode::kSilent, SafetyReason::kVehicleStale};
  if (in.autopilot.stamp_s < 0.0 || in.now_s - in.autopilot.stamp_s > p.autopilot_stale_s)
    return {SafetyMode::kSilent, SafetyReason::kAutopilotStale};
  switch (s.mission.phase) {
    case MissionPhase::kIdle:
    case MissionPhase::kReturning:
    case MissionPhase::kLanding:
      return {SafetyMode::kSilent, SafetyReason::kMission};
    case MissionPhase::kStopped:  // braking comes first, as for every hover from speed
    case MissionPhase::kHolding:
      return {SafetyMode::kHover, SafetyReason::kMission};
    case MissionPhase::kTracking:
      break;
  }
  return tracking_rung(s, in, r, p);
}

// A heartbeat with nothing behind it would hide a dead planner from the flight controller for ever.
bool has_waited_too_long(GateState& s, const GateInput& in, const SafetyParams& p) {
  const double alive_s = std::max(s.last_plan_s, s.idle_since_s);
  return s.mission.phase == MissionPhase::kTracking && in.now_s - alive_s > p.hover_limit_s;
}

// The vehicle tilts late: it is told the acceleration that it shall have when it will have tilted.
Setpoint sample(const PlannedTrajectory& plan, double now_s, double response_s) {
  const double t = now_s - plan.start_s;
  const AngleNode yaw = plan.yaw.at(t);
  return {.stamp_s = now_s,
          .position_enu_m = plan.position(t),
          .velocity_enu_m_s = plan.velocity(t),
          .acceleration_enu_m_s2 = plan.acceleration(t + response_s),
          .jerk_enu_m_s3 = plan.jerk(t),
          .yaw_rad = wrap_angle(yaw.angle_rad),
          .yaw_rate_rad_s = yaw.rate_rad_s};
}

Setpoint stand_still(const GateState& s, double now_s, bool brake) {
  Setpoint out;
  out.stamp_s = now_s;
  out.position_enu_m = brake || !s.hover_enu_m ? Vec3::Constant(kNaN) : *s.hover_enu_m;
  out.acceleration_enu_m_s2 = out.jerk_enu_m_s3 = Vec3::Constant(kNaN);
  out.yaw_rad = s.hover_yaw_rad;
  return out;
}

// Holds the end of the trajectory where there is one; else brakes first and holds where that ends.
void latch_hover(GateState& s, const GateInput& in, SafetyMode mode, SafetyReason reason,
                 const SafetyParams& p) {
  if (mode != SafetyMode::kHover) {  // also when it brakes: it shall not fly back to an old place
    s.hover_enu_m.reset();
    if (mode != SafetyMode::kBrake) s.hover_yaw_rad = in.vehicle.yaw_rad();
    return;
  }
  if (s.hover_enu_m) return;
  const bool at_end = reason == SafetyReason::kPlanEnded || reason == SafetyReason::kPlanHolds;
  if (at_end) {
    s.hover_enu_m = s.flown.position(s.flown.duration_s());
    s.hover_yaw_rad = s.flown.yaw.nodes.empty() ? in.vehicle.yaw_rad()
                                                : wrap_angle(s.flown.yaw.nodes.back().angle_rad);
  } else if (in.vehicle.velocity_enu_m_s.norm() < p.brake_done_m_s) {
    s.hover_enu_m = in.vehicle.position_enu_m;
  }
}

AutopilotRequest choose_request(GateState& s, const GateInput& in, const GateResult& r,
                                const SafetyParams& p) {
  if (in.now_s - s.last_request_s < p.request_period_s) return AutopilotRequest::kNone;
  AutopilotRequest request = AutopilotRequest::kNone;
  if (s.mission.phase == MissionPhase::kReturning) request = AutopilotRequest::kReturn;
  if (s.mission.phase == MissionPhase::kLanding) request = AutopilotRequest::kLand;
  if (r.heartbeat && !in.autopilot.offboard) request = AutopilotRequest::kOffboard;
  if (r.heartbeat && !in.autopilot.armed) request = AutopilotRequest::kArm;
  if (request != AutopilotRequest::kNone) s.last_request_s = in.now_s;
  return request;
}

}  // namespace

ParamRows rows(SafetyParams& p) {
  return {
      {"plan_fresh_s", &p.plan_fresh_s, "s", 0.05, 2.0, "a plan older than this coasts"},
      {"hover_limit_s", &p.hover_limit_s, "s", 0.5, 60.0,
       "without any plan for this long the heartbeat stops"},
      {"vehicle_stale_s", &p.vehicle_stale_s, "s", 0.05, 2.0, "oldest vehicle state to act on"},
      {"autopilot_stale_s", &p.autopilot_stale_s, "s", 0.1, 10.0,
       "longest silence of the flight controller"},
      {"max_deviation_m", &p.max_deviation_m, "m", 0.2, 5.0,
       "farther than this from the flown trajectory: brake"},
      {"brake_done_m_s", &p.brake_done_m_s, "m/s", 0.05, 1.0,
       "below this speed a position is held"},
      {"command_max_age_s", &p.command_max_age_s, "s", 0.1, 10.0, "older commands are refused"},
      {"lease_s", &p.lease_s, "s", 1.0, 60.0,
       "an operator's lease ends that long after it was last renewed"},
      {"request_period_s", &p.request_period_s, "s", 0.1, 5.0,
       "between requests to arm or to enter offboard mode"},
      {"response_s", &p.response_s, "s", 0.0, 1.0,
       "time in which the vehicle's tilt follows; accelerations are commanded so much ahead"},
      {"start_on_launch", &p.start_on_launch, "", 0, 1, "track at once, without a start command"},
  };
}

GateResult gate(GateState& state, const GateInput& in, const SafetyParams& params) {
  if (state.idle_since_s < 0.0) state.idle_since_s = in.now_s;
  take_command(state, in, params);
  take_plan(state, in);

  GateResult r;
  if (state.has_flown)
    r.deviation_m =
        (state.flown.position(in.now_s - state.flown.start_s) - in.vehicle.position_enu_m).norm();
  auto [mode, reason] = choose_rung(state, in, r, params);
  if (mode != SafetyMode::kSilent && has_waited_too_long(state, in, params))
    mode = SafetyMode::kSilent, reason = SafetyReason::kPlanStale;
  // Not yet at rest, and nothing says where to hold: take the speed out first.
  latch_hover(state, in, mode, reason, params);
  if (mode == SafetyMode::kHover && !state.hover_enu_m) mode = SafetyMode::kBrake;

  r.heartbeat = mode != SafetyMode::kSilent;
  r.request = choose_request(state, in, r, params);
  if (r.heartbeat && in.autopilot.offboard) {
    const bool flies = mode == SafetyMode::kTrack || mode == SafetyMode::kCoast;
    r.setpoint = flies ? sample(state.flown, in.now_s, params.response_s)
                       : stand_still(state, in.now_s, mode == SafetyMode::kBrake);
  } else if (r.heartbeat) {
    reason = SafetyReason::kNotOffboard;
  }
  r.mode = mode;
  r.reason = reason;
  r.phase = state.mission.phase;
  r.command_result = state.last_result;
  r.command_id = state.last_command.id;
  r.plan_age_s = state.last_plan_s < 0.0 ? -1.0 : in.now_s - state.last_plan_s;
  r.plan_id = state.has_flown ? state.flown.id : 0;
  return r;
}

std::string_view to_string(SafetyMode mode) {
  constexpr std::array<std::string_view, 5> names = {"track", "coast", "hover", "brake", "silent"};
  return names.at(static_cast<std::size_t>(mode));
}
std::string_view to_string(SafetyReason reason) {
  constexpr std::array<std::string_view, 10> names = {"",
                                                      "no plan yet",
                                                      "no fresh plan",
                                                      "the plan has ended",
                                                      "the planner holds",
                                                      "the vehicle is off its trajectory",
                                                      "no vehicle state",
                                                      "no word from the flight controller",
                                                      "not in offboard mode",
                                                      "an operator's order"};
  return names.at(static_cast<std::size_t>(reason));
}

}  // namespace foretrack
