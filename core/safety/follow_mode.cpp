// SPDX-License-Identifier: Apache-2.0
#include "core/safety/follow_mode.hpp"

#include <array>

namespace foretrack {

ModeHindrance hindrance_of(const FollowMode& mode, const Mission& mission,
                           const AutopilotStatus& status, double now_s, bool silent) {
  if (mission.engaged && status.own_mode)
    return silent ? ModeHindrance::kSilent : ModeHindrance::kNone;
  if (mission.phase == MissionPhase::kStopped) return ModeHindrance::kStopped;
  if (mission.lease.is_held(now_s)) return ModeHindrance::kLease;
  if (mode.over) return ModeHindrance::kOver;
  if (mission.phase != MissionPhase::kIdle && mission.phase != MissionPhase::kTracking)
    return ModeHindrance::kBusy;
  return now_s - mode.ready_s <= kReadyFor_s ? ModeHindrance::kNone : ModeHindrance::kNotReady;
}

bool start_by_pilot(const FollowMode& mode, Mission& mission, const AutopilotStatus& status,
                    double now_s) {
  const bool selected = status.own_mode && status.armed && !status.failsafe;
  if (!selected || mission.phase != MissionPhase::kIdle) return false;
  if (hindrance_of(mode, mission, status, now_s, false) != ModeHindrance::kNone) return false;
  mission.engaged = true;
  mission.phase = MissionPhase::kTracking;
  return true;
}

void note_end(FollowMode& mode, bool was_engaged, const Mission& mission,
              const AutopilotStatus& status) {
  if (!status.own_selected)
    mode.over = false;
  else if (was_engaged && !mission.engaged)
    mode.over = true;
}

std::string_view to_string(ModeHindrance hindrance) {
  constexpr std::array<std::string_view, 7> names = {
      "",
      "not ready",
      "an operator's stop stands: an order to start lifts it",
      "an operator has the vehicle",
      "an order is being carried out",
      "its mission has ended: select another mode, then this one again",
      "nothing can be commanded"};
  return names[static_cast<std::size_t>(hindrance)];
}

}  // namespace foretrack
