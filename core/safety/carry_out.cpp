// SPDX-License-Identifier: Apache-2.0
#include "core/safety/carry_out.hpp"

namespace foretrack {
namespace {

using Request = AutopilotRequest;

// One tick of one phase.
struct Step {
  CarryOut& s;
  Mission& mission;
  const CarryOutInput& in;
  const CarryOutParams& params;

  Request start();
  Request delegate();
  Request stand();
  Request give_to_pilot();

 private:
  Request ask(Request request) {
    s.asking = {request, in.now_s, false};
    s.asked = request;
    s.answer = CommandResult::kInProgress;
    return request;
  }
  Request end(MissionEnd why) {
    end_mission(s, mission, why);
    return Request::kNone;
  }
  AskProgress progress() {
    if (in.ack && in.ack->request == s.asked) s.answer = in.ack->result;
    return follow(s.asking, in.ack, in.status, in.now_s, params.ask);
  }
  Request request_of_phase() const;
};

// Under way to the flight controller's consent: arms before it asks for offboard mode.
Request Step::start() {
  const AutopilotStatus& status = in.status;
  if (const auto why = start_hindrance(status, s.mode_at_order); why != MissionEnd::kNone)
    return end(why);
  if (!status.armed && s.asked_arm && s.asking.request != Request::kArm)
    return end(MissionEnd::kDisarmed);
  const AskProgress asked = progress();
  if (asked.state == AskState::kWaits) return Request::kNone;
  if (asked.state == AskState::kFailed) return end(asked.why);
  if (status.armed && status.offboard) {
    mission.engaged = true;
    mission.phase = MissionPhase::kTracking;
    return Request::kNone;
  }
  if (s.asked_offboard) return end(MissionEnd::kOtherMode);
  if (in.ready && in.now_s - in.heartbeat_since_s >= params.heartbeat_before_s) {
    (status.armed ? s.asked_offboard : s.asked_arm) = true;
    return ask(status.armed ? Request::kOffboard : Request::kArm);
  }
  return in.now_s - s.since_s > params.patience_s ? end(MissionEnd::kNotReady) : Request::kNone;
}

Request Step::request_of_phase() const {
  if (mission.phase == MissionPhase::kReturning) return Request::kReturn;
  return mission.phase == MissionPhase::kLanding ? Request::kLand : Request::kTakeOff;
}

// Return, land, take off: asked for once, then left to the flight controller.
Request Step::delegate() {
  if (s.delegated) {
    const MissionEnd why = delegated_end(mission.phase, in.status);
    return why == MissionEnd::kNone ? Request::kNone : end(why);
  }
  if (mission.engaged)
    if (const auto why = taken_over(in.status);
        why != MissionEnd::kNone && why != MissionEnd::kOtherMode)
      return end(why);
  const AskProgress asked = progress();
  if (asked.state == AskState::kWaits) return Request::kNone;
  if (asked.state == AskState::kFailed) return hold_mission(s, mission, asked.why), Request::kNone;
  // PX4 arms in the mode it is in, which after a flight can be one that may not run: it takes the
  // mode to take off first, as it takes any while it is disarmed.
  if (s.asked_other && mission.phase == MissionPhase::kTakingOff && !in.status.armed) {
    if (s.asked_arm) return end(MissionEnd::kDisarmed);
    s.asked_arm = true;
    return ask(Request::kArm);
  }
  if (s.asked_other) {
    s.delegated = true;
    mission.engaged = false;
    return Request::kNone;
  }
  s.asked_other = s.by_itself = true;
  return ask(request_of_phase());
}

// PX4 hands a vehicle to moved sticks out of offboard mode, but not out of a registered one.
bool is_taken_by_sticks(const Mission& mission, const AutopilotStatus& status) {
  return mission.engaged && status.own_mode && taken_over(status) == MissionEnd::kSticks;
}

Request Step::give_to_pilot() {
  ask(Request::kPilot);
  end(MissionEnd::kSticks);
  return Request::kPilot;
}

bool flies_by_itself(FlightMode mode) {
  return mode == FlightMode::kReturn || mode == FlightMode::kLand || mode == FlightMode::kTakeOff ||
         mode == FlightMode::kUnknown;
}

// Stop and hold: ours under offboard mode. What the flight controller does at our request, also
// what it was asked for just before, it is asked once to leave.
Request Step::stand() {
  if (mission.engaged) {
    const MissionEnd why = taken_over(in.status);
    mission.engaged = why == MissionEnd::kNone;
    const bool late_answer = why == MissionEnd::kOtherMode && s.by_itself;
    return why == MissionEnd::kNone || late_answer ? Request::kNone : end(why);
  }
  if (!in.status.armed && mission.phase == MissionPhase::kHolding)
    return end(MissionEnd::kDisarmed);
  if (s.offboard_may_come && taken_over(in.status) == MissionEnd::kNone) {
    mission.engaged = true;
    s.offboard_may_come = false;
    return Request::kNone;
  }
  const AskProgress asked = progress();
  if (asked.state == AskState::kFailed) s.end = asked.why;
  if (asked.state == AskState::kDone) s.delegated = true;
  if (asked.state != AskState::kNothing) return Request::kNone;
  if (s.delegated && mission.phase == MissionPhase::kHolding) {
    const MissionEnd why = delegated_end(mission.phase, in.status);
    return why == MissionEnd::kNone ? Request::kNone : end(why);
  }
  const bool may_ask = s.by_itself && !s.asked_other && in.status.armed && !in.status.failsafe;
  if (!may_ask || !flies_by_itself(in.status.mode)) return Request::kNone;
  s.asked_other = true;
  return ask(Request::kHold);
}

}  // namespace

void begin_phase(CarryOut& state, double now_s, const AutopilotStatus& status) {
  const CarryOut before = state;
  state = {};
  state.since_s = now_s;
  state.mode_at_order = status.mode;
  state.by_itself = before.by_itself;
  state.offboard_may_come = before.asking.request == Request::kOffboard;
  state.asked = before.asked;
  state.answer = before.answer;
}

AutopilotRequest carry_out(CarryOut& state, Mission& mission, const CarryOutInput& input,
                           const CarryOutParams& params) {
  Step step{state, mission, input, params};
  if (is_taken_by_sticks(mission, input.status)) return step.give_to_pilot();
  switch (mission.phase) {
    case MissionPhase::kStarting:
      return step.start();
    case MissionPhase::kTracking:
      if (const auto why = taken_over(input.status); why != MissionEnd::kNone)
        end_mission(state, mission, why);
      break;
    case MissionPhase::kReturning:
    case MissionPhase::kLanding:
    case MissionPhase::kTakingOff:
      return step.delegate();
    case MissionPhase::kStopped:
    case MissionPhase::kHolding:
      return step.stand();
    default:  // idle
      break;
  }
  return Request::kNone;
}

AutopilotRequest ask_for_home(HomeAsking& home, CarryOut& state, const CarryOutInput& input,
                              const CarryOutParams& params) {
  const bool is_answered = input.ack && input.ack->request == Request::kHome;
  const bool waits = home.asked_s >= 0.0;
  if (waits && (is_answered || input.now_s - home.asked_s > params.ask.answer_s)) {
    state.answer = is_answered ? input.ack->result : CommandResult::kFailed;
    home.asked_s = -1.0;
  }
  if (!home.is_wanted || state.asking.request != Request::kNone) return Request::kNone;
  home.is_wanted = false;
  home.asked_s = input.now_s;
  state.asked = Request::kHome;
  state.answer = CommandResult::kInProgress;
  return Request::kHome;
}

void end_mission(CarryOut& state, Mission& mission, MissionEnd why) {
  mission.engaged = false;
  if (mission.phase != MissionPhase::kStopped) mission.phase = MissionPhase::kIdle;
  state.asking = {};
  state.by_itself = state.offboard_may_come = false;
  state.end = why;
}

void hold_mission(CarryOut& state, Mission& mission, MissionEnd why) {
  if (!mission.engaged) return end_mission(state, mission, why);
  mission.phase = MissionPhase::kHolding;
  state.asking = {};
  state.end = why;
}

}  // namespace foretrack
