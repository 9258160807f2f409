// SPDX-License-Identifier: Apache-2.0
#include "core/safety/mission.hpp"

#include <array>

namespace foretrack {
namespace {

bool is_allowed(MissionOrder order, MissionPhase phase) {
  switch (order) {
    case MissionOrder::kStart:
      return phase == MissionPhase::kIdle || phase == MissionPhase::kStopped;
    case MissionOrder::kHold:
      return phase == MissionPhase::kTracking || phase == MissionPhase::kReturning;
    case MissionOrder::kResume:
      return phase == MissionPhase::kHolding;
    case MissionOrder::kReturn:
    case MissionOrder::kLand:
      return phase != MissionPhase::kLanding;
    case MissionOrder::kStop:
    case MissionOrder::kLease:
    case MissionOrder::kRelease:
      return true;
  }
  return false;
}

MissionPhase phase_after(MissionOrder order, MissionPhase phase) {
  switch (order) {
    case MissionOrder::kStart:
    case MissionOrder::kResume:
      return MissionPhase::kTracking;
    case MissionOrder::kHold:
      return MissionPhase::kHolding;
    case MissionOrder::kReturn:
      return MissionPhase::kReturning;
    case MissionOrder::kLand:
      return MissionPhase::kLanding;
    case MissionOrder::kStop:
      return MissionPhase::kStopped;
    case MissionOrder::kLease:
    case MissionOrder::kRelease:
      break;
  }
  return phase;
}

// A lease without a secret would be anybody's.
bool is_foreign(const MissionCommand& command, const MissionLease& lease, double now_s) {
  if (command.order == MissionOrder::kLease && command.lease_id.empty()) return true;
  return lease.is_held(now_s) && command.lease_id != lease.id;
}

MissionResult judge(const MissionCommand& command, const Mission& mission, double now_s,
                    const MissionRules& rules) {
  if (command.order == MissionOrder::kStop) return MissionResult::kAccepted;
  if (command.id <= mission.last_id) return MissionResult::kRefusedRepeated;
  if (now_s - command.stamp_s > rules.max_age_s) return MissionResult::kRefusedLate;
  if (is_foreign(command, mission.lease, now_s)) return MissionResult::kRefusedForeign;
  if (!is_allowed(command.order, mission.phase)) return MissionResult::kRefusedPhase;
  return MissionResult::kAccepted;
}

}  // namespace

MissionResult apply(const MissionCommand& command, Mission& mission, double now_s,
                    const MissionRules& rules) {
  const MissionResult result = judge(command, mission, now_s, rules);
  const bool is_theirs =
      result == MissionResult::kAccepted || result == MissionResult::kRefusedPhase;
  // The ids of strangers and of the past must not make the holder's next one look repeated.
  if (is_theirs && command.id > mission.last_id) mission.last_id = command.id;
  if (result != MissionResult::kAccepted) return result;
  mission.phase = phase_after(command.order, mission.phase);
  if (command.order == MissionOrder::kLease)
    mission.lease = {command.lease_id, command.operator_name, now_s + rules.lease_s};
  if (command.order == MissionOrder::kRelease) mission.lease = {};
  return result;
}

std::string_view to_string(MissionOrder order) {
  constexpr std::array<std::string_view, 8> names = {"start", "hold", "resume", "return",
                                                     "land",  "stop", "lease",  "release"};
  return names.at(static_cast<std::size_t>(order));
}
std::string_view to_string(MissionPhase phase) {
  constexpr std::array<std::string_view, 6> names = {"idle",      "tracking", "holding",
                                                     "returning", "landing",  "stopped"};
  return names.at(static_cast<std::size_t>(phase));
}
std::string_view to_string(MissionResult result) {
  constexpr std::array<std::string_view, 6> names = {"none",
                                                     "accepted",
                                                     "refused: too late",
                                                     "refused: repeated",
                                                     "refused: not in this phase",
                                                     "refused: somebody else has the lease"};
  return names.at(static_cast<std::size_t>(result));
}

}  // namespace foretrack
