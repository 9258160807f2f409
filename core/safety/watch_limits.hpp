// SPDX-License-Identifier: Apache-2.0
// The limits that an operator sets to a flight, and what is done where one is reached.
#pragma once

#include "core/common/battery_state.hpp"
#include "core/safety/latch.hpp"
#include "core/safety/surroundings.hpp"

namespace foretrack {

/// The gentlest first.
enum class Reaction : std::uint8_t { kNone, kHold, kReturn, kLand };
/// Which limit was reached.
enum class LimitKind : std::uint8_t { kFence, kAltitude, kBattery, kLink };
inline constexpr int kLimitCount = 4;

/// The limits, and what is done where one is reached.
struct LimitParams {
  double battery_reserve = 0.15;  // share that is kept; 0: not watched
  double link_timeout_s = 0.0;    // without the operator's heartbeat; 0: none is asked for
  // Each a Reaction, by LimitKind.
  int reactions[kLimitCount] = {1, 1, 2, 1};
  double confirm_s = 0.2;      // a limit counts as reached after so long
  double clear_s = 2.0;        // and as kept again after so long
  double inward_m = 0.3;       // inside of the bounds, to count as kept again
  double battery_rise = 0.03;  // the same of the battery's share
};

/// What one tick is judged by.
struct LimitInput {
  double now_s = 0.0;
  Vec3 place_over_ground_m = Vec3::Zero();
  const FlightBounds* bounds = nullptr;
  const BatteryState* battery = nullptr;  // null: not known
  double operator_at_s = -1.0;            // last heartbeat; −1: never
};

/// Since when which limit is reached.
struct LimitWatch {
  Latch latches[kLimitCount];
  double since_s = -1.0;     // the first tick
  bool has_climbed = false;  // it begins on the ground, below the least altitude
};

/// The strongest reaction of those that are called for, and to what.
struct LimitVerdict {
  Reaction reaction = Reaction::kNone;
  LimitKind kind = LimitKind::kFence;
};
/// The least altitude counts from when the vehicle has first been above it.
LimitVerdict watch_limits(LimitWatch& watch, const LimitInput& input, const LimitParams& params);

}  // namespace foretrack
