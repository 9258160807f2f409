// SPDX-License-Identifier: Apache-2.0
// What of the gate must survive a kill. Written outside of its loop, read once at its start.
#pragma once

#include <type_traits>

#include "core/safety/mission.hpp"

namespace foretrack {

/// Copied to a file byte by byte; only a file of this version is read.
struct GateMemory {
  static constexpr std::uint32_t kVersion = 2;

  std::uint32_t version = kVersion;
  std::uint64_t revision = 0;  // grows with every change
  MissionPhase phase = MissionPhase::kIdle;
  ShortText lease_id;  // empty: nobody holds a lease
  ShortText lease_operator;
  OrderMark last_order;
  FlightBounds bounds;
  PersonChoice person;
  Framing framing;
};
static_assert(std::is_trivially_copyable_v<GateMemory>);

/// Takes over what of the mission is to be remembered, and counts a revision if that is news. The
/// renewal of a lease is none. Returns whether it was.
bool remember(GateMemory& memory, const Mission& mission);

/// The mission after a restart. Nothing is resumed: stopped and holding stay so, what was flown
/// holds (until the flight controller says that it is not under offboard mode: see Gate), what the
/// flight controller was left to do is idle. The holder of the lease has a full term to renew it.
/// A memory of another version, or damaged, is as none; so is a framing that is not allowed any
/// more.
Mission mission_of(const GateMemory& memory, double now_s, const MissionRules& rules);

}  // namespace foretrack
