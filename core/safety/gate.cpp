// SPDX-License-Identifier: Apache-2.0
#include "core/safety/gate.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/common/ground.hpp"

namespace foretrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kConfirm_s = 0.1;  // in which a newer plan may lead clear of what is in the way
constexpr double kOfLate_s = 1.0;   // after so long without plans, a planner may count anew

bool is_known(double at_s, double now_s, double stale_s) {
  return at_s >= 0.0 && now_s - at_s <= stale_s;
}

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

bool is_flown_or_waits(const GateState& s, std::uint64_t id) {
  return (s.has_flown && id == s.flown.id) || (s.has_next && id == s.next.id);
}

GateSurroundings surroundings_of(const GateState& s, const GateInput& in, const SafetyParams& p) {
  GateSurroundings around;
  // A map that was given once and for all has no stamp.
  if (in.map && (in.map->stamp_s == 0.0 || is_known(in.map_at_s, in.now_s, p.map_stale_s)))
    around.map = in.map->empty() ? nullptr : in.map;
  if (is_known(in.bodies_at_s, in.now_s, p.bodies_stale_s)) around.bodies = in.bodies;
  around.ground_m = s.ground_m;
  around.bounds = s.mission.bounds;
  around.bounds.altitude_min_m = std::max(around.bounds.altitude_min_m, p.altitude_min_m);
  around.bounds.altitude_max_m = std::min(around.bounds.altitude_max_m, p.altitude_max_m);
  return around;
}

Situation situation_of(const GateState& s, const GateInput& in, const SafetyParams& p) {
  Situation now;
  now.moment = {in.now_s, in.stamp_now_s};
  const VehicleState& vehicle = s.odometry.state;
  const double since_s = in.now_s - s.odometry.at_s;
  now.vehicle.position_enu_m = vehicle.position_enu_m + since_s * vehicle.velocity_enu_m_s;
  now.vehicle.velocity_enu_m_s = vehicle.velocity_enu_m_s;
  now.vehicle.yaw_rad = vehicle.yaw_rad();
  now.around = surroundings_of(s, in, p);
  now.deviation = &s.deviation;
  if (is_known(s.last_plan_s, in.now_s, kOfLate_s)) now.last_id = s.newest_id;
  if (s.has_next)
    now.last_start_s = s.next.start_s;
  else if (s.has_flown)
    now.last_start_s = s.flown.start_s;
  return now;
}

// The newest is checked, and waits until its start, so that the switch is where the planner made it
// continuous. The one that waits starts before a newer one takes its place.
void take_plan(GateState& s, const GateInput& in, const SafetyParams& p) {
  start_next(s, in.now_s);
  if (in.plan) {
    const PlannedTrajectory& plan = *in.plan;
    s.last_heard_s = in.now_s;
    s.refusal = PlanFault::kNone;
    if (!plan.pieces.empty() && !is_flown_or_waits(s, plan.id)) {
      Situation now = situation_of(s, in, p);
      if (s.flies_plans)  // a plan that starts before the one that waits is out of order
        now.flown = s.has_next ? &s.next : &s.flown;
      s.refusal = check_plan(plan, now, p.plan_check());
      if (s.refusal == PlanFault::kNone) {
        copy_flown(plan, in.now_s - in.stamp_now_s, s.next);
        s.has_next = true;
        s.newest_id = plan.id;
      } else {
        ++s.refused[static_cast<std::size_t>(s.refusal)];
      }
    }
    if (s.refusal == PlanFault::kNone) {
      s.last_plan_s = in.now_s;
      if (plan.status == PlanStatus::kFresh) s.last_fresh_s = in.now_s;
    }
  }
  start_next(s, in.now_s);
}

void ask_autopilot(GateState& s, const GateInput& in, const SafetyParams& p, GateResult& r) {
  const bool ready = s.mode == SafetyMode::kTrack && in.now_s - s.last_fresh_s <= p.plan_fresh_s;
  const CarryOutInput input{in.now_s, in.autopilot, in.ack, ready, s.heartbeat_since_s};
  const CarryOutParams params = p.carry_out();
  if (start_by_pilot(s.follow_mode, s.mission, in.autopilot, in.now_s))
    begin_phase(s.carrying, in.now_s, in.autopilot);
  const bool was_engaged = s.mission.engaged;
  r.request = carry_out(s.carrying, s.mission, input, params);
  note_end(s.follow_mode, was_engaged, s.mission, in.autopilot);
  if (r.request == AutopilotRequest::kNone)
    r.request = ask_for_home(s.home, s.carrying, input, params);
  r.return_place_enu_m = s.home.place_enu_m;
}

// Orders, and what the flight controller lets us do.
void conduct(GateState& s, const GateInput& in, const SafetyParams& p, GateResult& r) {
  settle_orders(s.order, s.mission, s.carrying, in.writing);
  if (!in.command)
    answer_order(s.order);
  else
    take_order(s.order, s.mission, s.carrying, *in.command, {in.now_s, in.stamp_now_s},
               in.autopilot, p.mission_rules(), surroundings_of(s, in, p).bodies);
  if (in.command && in.command->order == MissionOrder::kSetReturnPlace &&
      s.order.result == MissionResult::kAccepted)
    s.home = {in.command->return_place_enu_m, true};
  if (is_known(in.autopilot_at_s, in.now_s, p.autopilot_stale_s)) ask_autopilot(s, in, p, r);
}

void write_memory(GateState& s, const GateInput& in, GateResult& r) {
  r.memory_changed = remember(s.memory, s.mission);
  if (!in.command) return;
  await_writing(s.order, s.memory, r.memory_changed);
  if (s.order.result != MissionResult::kPending) return;
  settle_orders(s.order, s.mission, s.carrying, in.writing);
  answer_order(s.order);
}

// Odometry, images and limits. A limit may end the mission.
void watch_inputs(GateState& s, const GateInput& in, const SafetyParams& p, LadderInput& ladder) {
  const double dt_s = s.ticked_s < 0.0 ? 0.0 : in.now_s - s.ticked_s;
  ladder.odometry = watch_odometry(s.odometry, s.commanded_enu_m_s, dt_s, in.now_s, p.odometry());
  ladder.autopilot_lost = !is_known(in.autopilot_at_s, in.now_s, p.autopilot_stale_s);
  ladder.vehicle_lost = !is_known(s.odometry.at_s, in.now_s, p.vehicle_lost_s);
  ladder.vehicle_stale = s.vehicle_latch.update(
      !is_known(s.odometry.at_s, in.now_s, p.vehicle_stale_s), in.now_s, 0.0, p.recover_s);
  ladder.images_blind =
      s.image_latch.update(p.heeds_images && in.images_blind, in.now_s, 0.0, p.recover_s);
  if (ladder.vehicle_lost) return;
  const GateSurroundings around = surroundings_of(s, in, p);
  const Vec3& place = s.odometry.state.position_enu_m;
  if (around.map) s.ground_m = ground_below_m(*around.map, place).value_or(s.ground_m);
  ladder.limit = watch_limits(s.limits,
                              {.now_s = in.now_s,
                               .place_over_ground_m = place - s.ground_m * Vec3::UnitZ(),
                               .bounds = &around.bounds,
                               .battery = in.battery,
                               .operator_at_s = in.operator_at_s},
                              p.limits());
}

// A limit that calls for it sends the vehicle home or down: once, as an order would.
void react(GateState& s, const GateInput& in, const LimitVerdict& limit) {
  if (limit.reaction < Reaction::kReturn || s.mission.phase != MissionPhase::kTracking) return;
  s.mission.phase =
      limit.reaction == Reaction::kReturn ? MissionPhase::kReturning : MissionPhase::kLanding;
  begin_phase(s.carrying, in.now_s, in.autopilot);
  s.carrying.end = limit.kind == LimitKind::kBattery ? MissionEnd::kBattery
                   : limit.kind == LimitKind::kLink  ? MissionEnd::kLink
                                                     : MissionEnd::kFence;
}

// How far the vehicle was from where it should be, when it said where it is.
void measure_deviation(GateState& s) {
  const double t_s = s.odometry.at_s - s.flown.start_s;
  if (!s.flies_plans || t_s < 0.0 || s.odometry.at_s == s.measured_s) return;
  s.measured_s = s.odometry.at_s;
  s.deviation.add(s.flown, t_s, s.odometry.state.position_enu_m);
}

void look_at_plan(GateState& s, const GateInput& in, const SafetyParams& p, LadderInput& ladder,
                  GateResult& r) {
  ladder.phase = s.mission.phase;
  ladder.engaged = s.mission.engaged;
  ladder.planner_lost = in.now_s - std::max(s.last_heard_s, s.begun_s) > p.hover_limit_s;
  ladder.has_plan = s.has_flown;
  if (!s.has_flown) return;
  measure_deviation(s);
  const double t_s = in.now_s - s.flown.start_s;
  r.deviation_m = (s.flown.position(t_s) - s.odometry.state.position_enu_m).norm();
  ladder.off_trajectory = r.deviation_m > p.max_deviation_m;
  ladder.plan_fresh = is_known(s.last_plan_s, in.now_s, p.plan_fresh_s);
  ladder.plan_ended = t_s > s.flown.duration_s();
  Situation now = situation_of(s, in, p);
  now.flown = &s.flown;
  const PlanFault fault = ladder.plan_ended ? PlanFault::kNone : check_flown(now, p.plan_check());
  if (fault != PlanFault::kNone) s.flown_fault = fault;
  const bool unsafe =
      s.flown_latch.update(fault != PlanFault::kNone, in.now_s, kConfirm_s, p.recover_s);
  ladder.flown = unsafe ? s.flown_fault : PlanFault::kNone;
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

// Where it brakes there is no place to hold.
Setpoint stand_still(const GateState& s, double stamp_s) {
  Setpoint out;
  out.stamp_s = stamp_s;
  out.position_enu_m = s.hover_enu_m.value_or(Vec3::Constant(kNaN));
  out.acceleration_enu_m_s2 = out.jerk_enu_m_s3 = Vec3::Constant(kNaN);
  out.yaw_rad = s.hover_yaw_rad;
  return out;
}

// Holds the end of the trajectory where there is one; else brakes first and holds where that ends.
void latch_hover(GateState& s, const Rung& rung, const SafetyParams& p) {
  const VehicleState& vehicle = s.odometry.state;
  if (rung.mode != SafetyMode::kHover) {  // also when it brakes: it shall not fly back
    s.hover_enu_m.reset();
    if (rung.mode != SafetyMode::kBrake) s.hover_yaw_rad = vehicle.yaw_rad();
    return;
  }
  if (s.hover_enu_m) return;
  if (rung.reason == SafetyReason::kPlanEnded || rung.reason == SafetyReason::kPlanHolds) {
    s.hover_enu_m = s.flown.position(s.flown.duration_s());
    s.hover_yaw_rad = wrap_angle(s.flown.yaw.nodes.back().angle_rad);
  } else if (vehicle.velocity_enu_m_s.norm() < p.brake_done_m_s) {
    s.hover_enu_m = vehicle.position_enu_m;
  }
}

bool is_of_plan(SafetyMode mode) {
  return mode == SafetyMode::kTrack || mode == SafetyMode::kCoast;
}

void give_setpoint(GateState& s, const GateInput& in, Rung rung, const SafetyParams& p,
                   GateResult& r) {
  // Not yet at rest, and nothing says where to hold: take the speed out first.
  latch_hover(s, rung, p);
  if (rung.mode == SafetyMode::kHover && !s.hover_enu_m) rung.mode = SafetyMode::kBrake;
  r.heartbeat = rung.mode != SafetyMode::kSilent;
  s.heartbeat_since_s = r.heartbeat ? std::min(s.heartbeat_since_s, in.now_s) : 1e18;
  if (r.heartbeat && in.autopilot.offboard)
    r.setpoint =
        is_of_plan(rung.mode) ? sample(s.flown, in, p.response_s) : stand_still(s, in.stamp_now_s);
  else if (r.heartbeat)
    rung.reason = SafetyReason::kNotOffboard;
  s.commanded_enu_m_s =
      r.setpoint && in.autopilot.armed ? r.setpoint->velocity_enu_m_s : Vec3::Zero();
  r.mode = s.mode = rung.mode;
  r.reason = rung.reason;
  s.flies_plans = flies_plan(r);
}

// Whether the mode that a pilot selects could fly, or go on.
void judge_mode(GateState& s, const GateInput& in, LadderInput ladder, const SafetyParams& p,
                GateResult& r) {
  ladder.phase = MissionPhase::kStarting;
  const Rung rung = choose_rung(ladder);
  if (rung.mode == SafetyMode::kTrack && in.now_s - s.last_fresh_s <= p.plan_fresh_s)
    s.follow_mode.ready_s = in.now_s;
  r.mode_hindrance =
      hindrance_of(s.follow_mode, s.mission, in.autopilot, in.now_s, s.mode == SafetyMode::kSilent);
  r.mode_reason = r.mode_hindrance == ModeHindrance::kSilent ? r.reason : rung.reason;
}

void fill_report(const GateState& s, const GateInput& in, GateResult& r) {
  r.phase = s.mission.phase;
  r.end = s.carrying.end;
  r.asked = s.carrying.asked;
  r.answer = s.carrying.answer;
  r.command_result = s.order.result;
  r.command_id = s.order.last.id;
  r.plan_age_s = s.last_plan_s < 0.0 ? -1.0 : in.now_s - s.last_plan_s;
  r.plan_id = s.has_flown ? s.flown.id : 0;
  r.refusal = s.refusal;
  r.person = s.mission.person;
  r.framing = s.mission.framing;
  r.bounds = s.mission.bounds;
}

}  // namespace

GateState::GateState() {
  for (PlannedTrajectory* plan : {&flown, &next}) {
    plan->pieces.reserve(kMaxPlanPieces);
    plan->yaw.nodes.reserve(kMaxPlanNodes);
  }
}

bool flies_plan(const GateResult& result) {
  return result.setpoint && is_of_plan(result.mode);
}

GateResult gate(GateState& state, const GateInput& in, const SafetyParams& params) {
  if (state.begun_s < 0.0) state.begun_s = in.now_s;
  GateResult r;
  LadderInput ladder;
  take_odometry(state.odometry, in.vehicle, in.vehicle_at_s, {in.now_s, in.stamp_now_s},
                params.odometry());
  take_plan(state, in, params);
  watch_inputs(state, in, params, ladder);
  react(state, in, ladder.limit);
  conduct(state, in, params, r);
  look_at_plan(state, in, params, ladder, r);
  give_setpoint(state, in, choose_rung(ladder), params, r);
  judge_mode(state, in, ladder, params, r);
  write_memory(state, in, r);
  r.limit = ladder.limit;
  fill_report(state, in, r);
  state.ticked_s = in.now_s;
  return r;
}

void restore(GateState& state, const GateMemory& memory, double now_s, const SafetyParams& params) {
  state.mission = mission_of(memory, now_s, params.mission_rules());
  state.memory = memory;
}

}  // namespace foretrack
