// SPDX-License-Identifier: Apache-2.0
#include "core/safety/gate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace foretrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMaxPieces = 64, kMaxNodes = 512;

struct Rung {
  SafetyMode mode;
  SafetyReason reason;
};

// What is flown of a plan, into memory that is there.
void copy_flown(const PlannedTrajectory& from, double clock_offset_s, PlannedTrajectory& to) {
  to.id = from.id;
  to.stamp_s = from.stamp_s;
  to.start_s = from.start_s + clock_offset_s;
  to.pieces.assign(from.pieces.begin(), from.pieces.end());
  to.tail_start_s = from.tail_start_s;
  to.yaw.dt_s = from.yaw.dt_s;
  to.yaw.nodes.assign(from.yaw.nodes.begin(), from.yaw.nodes.end());
  to.status = from.status;
  to.reason = from.reason;
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
    if (in.plan->status == PlanStatus::kFresh) s.last_fresh_s = in.now_s;
    const bool fits = !in.plan->pieces.empty() && in.plan->pieces.size() <= kMaxPieces &&
                      in.plan->yaw.nodes.size() <= kMaxNodes;
    const bool is_new = fits && !(s.has_flown && in.plan->id == s.flown.id) &&
                        !(s.has_next && in.plan->id == s.next.id);
    if (is_new) {
      copy_flown(*in.plan, in.now_s - in.stamp_now_s, s.next);
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

bool is_known(double at_s, double now_s, double stale_s) {
  return at_s >= 0.0 && now_s - at_s <= stale_s;
}

Rung choose_rung(GateState& s, const GateInput& in, const GateResult& r, const SafetyParams& p) {
  if (!is_known(in.vehicle_at_s, in.now_s, p.vehicle_stale_s))
    return {SafetyMode::kSilent, SafetyReason::kVehicleStale};
  if (!is_known(in.autopilot_at_s, in.now_s, p.autopilot_stale_s))
    return {SafetyMode::kSilent, SafetyReason::kAutopilotStale};
  if (s.mission.phase == MissionPhase::kTracking || s.mission.phase == MissionPhase::kStarting)
    return tracking_rung(s, in, r, p);
  // Until the flight controller has taken over what it was asked for, the place is held.
  // Braking comes first, as for every hover from speed.
  return {s.mission.engaged ? SafetyMode::kHover : SafetyMode::kSilent, SafetyReason::kMission};
}

// A heartbeat with nothing behind it would hide a dead planner from the flight controller for ever.
bool has_waited_too_long(GateState& s, const GateInput& in, const SafetyParams& p) {
  const double alive_s = std::max(s.last_plan_s, s.idle_since_s);
  return s.mission.phase == MissionPhase::kTracking && in.now_s - alive_s > p.hover_limit_s;
}

// The vehicle tilts late: it is told the acceleration that it shall have when it will have tilted.
Setpoint sample(const PlannedTrajectory& plan, const GateInput& in, double response_s) {
  const double t = in.now_s - plan.start_s;
  const AngleNode yaw = plan.yaw.at(t);
  return {.stamp_s = in.stamp_now_s,
          .position_enu_m = plan.position(t),
          .velocity_enu_m_s = plan.velocity(t),
          .acceleration_enu_m_s2 = plan.acceleration(t + response_s),
          .jerk_enu_m_s3 = plan.jerk(t),
          .yaw_rad = wrap_angle(yaw.angle_rad),
          .yaw_rate_rad_s = yaw.rate_rad_s};
}

Setpoint stand_still(const GateState& s, double stamp_s, bool brake) {
  Setpoint out;
  out.stamp_s = stamp_s;
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

// Orders, and what the flight controller lets us do.
void conduct(GateState& s, const GateInput& in, const SafetyParams& p, GateResult& r) {
  settle_order(s.order, s.mission, s.carrying, in.writing);
  if (in.command)
    take_order(s.order, s.mission, s.carrying, *in.command, {in.now_s, in.stamp_now_s},
               in.autopilot, p.mission_rules());
  if (is_known(in.autopilot_at_s, in.now_s, p.autopilot_stale_s)) {
    const bool ready = in.now_s - s.last_fresh_s <= p.plan_fresh_s;
    r.request =
        carry_out(s.carrying, s.mission,
                  {in.now_s, in.autopilot, in.ack, ready, s.heartbeat_since_s}, p.carry_out());
  }
  r.memory_changed = remember(s.memory, s.mission);
  if (in.command) {
    await_writing(s.order, s.memory, r.memory_changed);
    settle_order(s.order, s.mission, s.carrying, in.writing);
  }
}

void report(const GateState& s, const GateInput& in, GateResult& r) {
  r.phase = s.mission.phase;
  r.end = s.carrying.end;
  r.asked = s.carrying.asked;
  r.answer = s.carrying.answer;
  r.command_result = s.order.result;
  r.command_id = s.order.last.id;
  r.plan_age_s = s.last_plan_s < 0.0 ? -1.0 : in.now_s - s.last_plan_s;
  r.plan_id = s.has_flown ? s.flown.id : 0;
}

}  // namespace

GateState::GateState() {
  for (PlannedTrajectory* plan : {&flown, &next}) {
    plan->pieces.reserve(kMaxPieces);
    plan->yaw.nodes.reserve(kMaxNodes);
  }
}

GateResult gate(GateState& state, const GateInput& in, const SafetyParams& params) {
  if (state.idle_since_s < 0.0) state.idle_since_s = in.now_s;
  GateResult r;
  take_plan(state, in);
  conduct(state, in, params, r);
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
  state.heartbeat_since_s = r.heartbeat ? std::min(state.heartbeat_since_s, in.now_s) : 1e18;
  if (r.heartbeat && in.autopilot.offboard) {
    const bool flies = mode == SafetyMode::kTrack || mode == SafetyMode::kCoast;
    r.setpoint = flies ? sample(state.flown, in, params.response_s)
                       : stand_still(state, in.stamp_now_s, mode == SafetyMode::kBrake);
  } else if (r.heartbeat) {
    reason = SafetyReason::kNotOffboard;
  }
  r.mode = mode;
  r.reason = reason;
  report(state, in, r);
  return r;
}

void restore(GateState& state, const GateMemory& memory, double now_s, const SafetyParams& params) {
  state.mission = mission_of(memory, now_s, params.mission_rules());
  state.memory = memory;
}

std::string_view to_string(SafetyMode mode) {
  constexpr std::array<std::string_view, 5> names = {"track", "coast", "hover", "brake", "silent"};
  return names[static_cast<std::size_t>(mode)];
}
std::string_view to_string(SafetyReason reason) {
  constexpr std::array<std::string_view, 20> names = {
      "",
      "no plan yet",
      "no fresh plan",
      "the plan has ended",
      "the planner holds",
      "the vehicle is off its trajectory",
      "no vehicle state",
      "no word from the flight controller",
      "not in offboard mode",
      "an operator's order",
      "the odometry jumps",
      "the odometry is frozen",
      "the odometry disagrees with its own velocity",
      "an obstacle is in the way",
      "somebody is in the way",
      "outside of the fence",
      "outside of the altitudes",
      "the battery is at its reserve",
      "no word from the operator",
      "the images are frozen, dark or covered"};
  return names[static_cast<std::size_t>(reason)];
}

}  // namespace foretrack
