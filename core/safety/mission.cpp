// SPDX-License-Identifier: Apache-2.0
#include "core/safety/mission.hpp"

#include <algorithm>
#include <array>

#include "core/safety/surroundings.hpp"

namespace foretrack {
namespace {

bool is_allowed(MissionOrder order, MissionPhase phase) {
  switch (order) {
    case MissionOrder::kStart:
    case MissionOrder::kTakeOff:
      return phase == MissionPhase::kIdle || phase == MissionPhase::kStopped;
    case MissionOrder::kHold:
      return phase == MissionPhase::kTracking || phase == MissionPhase::kReturning ||
             phase == MissionPhase::kTakingOff;
    case MissionOrder::kResume:
      return phase == MissionPhase::kHolding;
    case MissionOrder::kReturn:
      return phase != MissionPhase::kLanding;
    case MissionOrder::kSetReturnPlace:  // not on the way there
      return phase != MissionPhase::kReturning && phase != MissionPhase::kLanding;
    default:
      return true;
  }
}

MissionPhase phase_after(MissionOrder order, const Mission& mission) {
  switch (order) {
    case MissionOrder::kStart:
    case MissionOrder::kResume:
      return mission.engaged ? MissionPhase::kTracking : MissionPhase::kStarting;
    case MissionOrder::kHold:
      return MissionPhase::kHolding;
    case MissionOrder::kReturn:
      return MissionPhase::kReturning;
    case MissionOrder::kLand:
      return MissionPhase::kLanding;
    case MissionOrder::kStop:
      return MissionPhase::kStopped;
    case MissionOrder::kTakeOff:
      return MissionPhase::kTakingOff;
    default:  // about the lease, or a setting
      return mission.phase;
  }
}

MissionResult judge_time(const MissionCommand& command, const Mission& mission,
                         const Moment& moment, const MissionRules& rules) {
  const OrderMark mark{command.stamp_s, command.id};
  if (!(command.stamp_s <= moment.stamp_now_s + rules.future_s))
    return MissionResult::kRefusedFuture;
  if (moment.stamp_now_s - command.stamp_s > rules.max_age_s) return MissionResult::kRefusedLate;
  return mark > mission.last_order ? MissionResult::kAccepted : MissionResult::kRefusedRepeated;
}

MissionResult judge_sender(const MissionCommand& command, const Mission& mission,
                           const Moment& moment) {
  const bool held = mission.lease.is_held(moment.now_s);
  if (held && command.lease_id != mission.lease.id) return MissionResult::kRefusedForeign;
  if (command.order == MissionOrder::kLease && command.lease_id.empty())
    return MissionResult::kRefusedUnproved;  // it would be anybody's
  if (is_setting(command.order) && !held)
    return MissionResult::kRefusedUnproved;  // it outlives who made it
  const bool needs_proof = held || command.order == MissionOrder::kLease;
  return needs_proof && !command.proved ? MissionResult::kRefusedUnproved
                                        : MissionResult::kAccepted;
}

MissionResult judge(const MissionCommand& command, const Mission& mission, const Moment& moment,
                    const MissionRules& rules) {
  if (command.order == MissionOrder::kStop) return MissionResult::kAccepted;
  if (command.order != MissionOrder::kLand)
    if (const auto time = judge_time(command, mission, moment, rules);
        time != MissionResult::kAccepted)
      return time;
  return judge_sender(command, mission, moment);
}

bool is_there(const MovingBodies* bodies, std::uint32_t id) {
  return bodies && std::ranges::any_of(bodies->all(), [&](const MovingBody& body) {
           return body.id == id && body.kind == BodyKind::kPerson;
         });
}

bool is_in_fence(const FlightBounds::Corner& place_enu_m, const FlightBounds& bounds) {
  FlightBounds fence;  // at any altitude
  fence.corner_count = bounds.corner_count;
  fence.corners_enu_m = bounds.corners_enu_m;
  return room_m(fence, Vec3(place_enu_m.x_m, place_enu_m.y_m, 0.0)) >= 0.0;
}

MissionResult judge_setting(const MissionCommand& command, const FlightBounds& bounds,
                            const MissionRules& rules, const MovingBodies* bodies) {
  switch (command.order) {
    case MissionOrder::kSetBounds:
      return are_valid(command.bounds) ? MissionResult::kAccepted : MissionResult::kRefusedBounds;
    case MissionOrder::kFollow:
      return command.person_id == 0 || is_there(bodies, command.person_id)
                 ? MissionResult::kAccepted
                 : MissionResult::kRefusedPerson;
    case MissionOrder::kSetFraming:
      return is_safe(command.framing, rules.framing) ? MissionResult::kAccepted
                                                     : MissionResult::kRefusedFraming;
    case MissionOrder::kSetReturnPlace:
      return is_in_fence(command.return_place_enu_m, bounds) ? MissionResult::kAccepted
                                                             : MissionResult::kRefusedPlace;
    default:
      return MissionResult::kAccepted;
  }
}

void execute(const MissionCommand& command, Mission& mission, const Moment& moment,
             const MissionRules& rules) {
  mission.phase = phase_after(command.order, mission);
  if (command.order == MissionOrder::kLease)
    mission.lease = {command.lease_id, command.operator_name, moment.now_s + rules.lease_s};
  if (command.order == MissionOrder::kRelease) mission.lease = {};
  if (command.order == MissionOrder::kSetBounds) mission.bounds = command.bounds;
  if (command.order == MissionOrder::kFollow) mission.person = {true, command.person_id};
  if (command.order == MissionOrder::kSetFraming) mission.framing = command.framing;
}

// Nobody judges the stamps of stop and land: what was given before they came is over.
OrderMark mark_of(const MissionCommand& command, const Moment& moment) {
  const bool judged = command.order != MissionOrder::kStop && command.order != MissionOrder::kLand;
  return {judged ? command.stamp_s : moment.stamp_now_s, command.id};
}

}  // namespace

MissionResult apply(const MissionCommand& command, Mission& mission, const Moment& moment,
                    const MissionRules& rules, const MovingBodies* bodies) {
  // Our clock was set back: what it said before tells nothing.
  if (mission.last_order.stamp_s > moment.stamp_now_s + rules.future_s) mission.last_order = {};
  const MissionResult result = judge(command, mission, moment, rules);
  // What strangers say, and what is too old, must not make the holder's next order look repeated.
  if (result != MissionResult::kAccepted) return result;
  if (const OrderMark mark = mark_of(command, moment); mark > mission.last_order)
    mission.last_order = mark;
  if (!is_allowed(command.order, mission.phase)) return MissionResult::kRefusedPhase;
  if (const auto setting = judge_setting(command, mission.bounds, rules, bodies);
      setting != MissionResult::kAccepted)
    return setting;
  execute(command, mission, moment, rules);
  return MissionResult::kAccepted;
}

bool needs_memory(MissionOrder order) {
  switch (order) {
    case MissionOrder::kStart:
    case MissionOrder::kResume:
    case MissionOrder::kTakeOff:
    case MissionOrder::kLease:
      return true;
    default:
      return is_setting(order) && order != MissionOrder::kSetReturnPlace;
  }
}

bool is_active(MissionPhase phase) {
  return phase == MissionPhase::kStarting || phase == MissionPhase::kTracking ||
         phase == MissionPhase::kTakingOff;
}

std::string_view to_string(MissionOrder order) {
  constexpr std::array<std::string_view, 13> names = {
      "start",  "hold",        "resume",          "return",   "land",
      "stop",   "lease",       "release",         "take_off", "set_bounds",
      "follow", "set_framing", "set_return_place"};
  return names[static_cast<std::size_t>(order)];
}
std::string_view to_string(MissionPhase phase) {
  constexpr std::array<std::string_view, 8> names = {
      "idle", "tracking", "holding", "returning", "landing", "stopped", "starting", "taking off"};
  return names[static_cast<std::size_t>(phase)];
}
std::string_view to_string(MissionResult result) {
  constexpr std::array<std::string_view, 15> names = {
      "none",
      "accepted",
      "refused: too late",
      "refused: repeated",
      "refused: not in this phase",
      "refused: somebody else has the lease",
      "refused: stamped in the future",
      "refused: no proof that it comes from the lease's holder",
      "refused: it cannot be written, and would be forgotten in a restart",
      "refused: these are no bounds",
      "acts, and is being written",
      "accepted, but a restart would forget it",
      "refused: nobody of that number is there",
      "refused: this framing is out of its safe ranges",
      "refused: this place is outside of the fence"};
  return names[static_cast<std::size_t>(result)];
}

}  // namespace foretrack
