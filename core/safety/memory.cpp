// SPDX-License-Identifier: Apache-2.0
#include "core/safety/memory.hpp"

namespace foretrack {
namespace {

MissionPhase phase_after_restart(MissionPhase before) {
  switch (before) {
    case MissionPhase::kStopped:
      return MissionPhase::kStopped;
    case MissionPhase::kHolding:
    case MissionPhase::kTracking:
    case MissionPhase::kStarting:
      return MissionPhase::kHolding;
    default:  // idle, or left to the flight controller
      return MissionPhase::kIdle;
  }
}

bool is_same(const GateMemory& memory, const Mission& mission) {
  return memory.phase == mission.phase && memory.lease_id == mission.lease.id &&
         memory.lease_operator == mission.lease.operator_name && memory.bounds == mission.bounds &&
         memory.person == mission.person && memory.framing == mission.framing;
}

bool is_sound(const GateMemory& memory) {
  return memory.version == GateMemory::kVersion && memory.phase <= MissionPhase::kTakingOff &&
         memory.lease_id.length <= ShortText::kCapacity &&
         memory.lease_operator.length <= ShortText::kCapacity && are_valid(memory.bounds);
}

}  // namespace

bool remember(GateMemory& memory, const Mission& mission) {
  if (is_same(memory, mission)) return false;
  ++memory.revision;
  memory.phase = mission.phase;
  memory.lease_id = mission.lease.id;
  memory.lease_operator = mission.lease.operator_name;
  memory.last_order = mission.last_order;
  memory.bounds = mission.bounds;
  memory.person = mission.person;
  memory.framing = mission.framing;
  return true;
}

Mission mission_of(const GateMemory& memory, double now_s, const MissionRules& rules) {
  Mission mission;
  if (!is_sound(memory)) return mission;
  mission.phase = phase_after_restart(memory.phase);
  mission.engaged = mission.phase != MissionPhase::kIdle;  // until the flight controller denies it
  if (!memory.lease_id.empty())
    mission.lease = {memory.lease_id, memory.lease_operator, now_s + rules.lease_s};
  mission.last_order = memory.last_order;
  mission.bounds = memory.bounds;
  mission.person = memory.person;
  if (is_safe(memory.framing, rules.framing)) mission.framing = memory.framing;
  return mission;
}

}  // namespace foretrack
