// SPDX-License-Identifier: Apache-2.0
// The mode that we register with the flight controller, for a pilot to select: whether it may run,
// and when selecting it is a start.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/common/vehicle.hpp"
#include "core/safety/mission.hpp"

namespace foretrack {

/// Why the mode may not be selected, or not go on.
enum class ModeHindrance : std::uint8_t {
  kNone,
  kNotReady,  // no target, map or fresh plan, or something forbids to fly it
  kStopped,   // an operator's stop stands
  kLease,     // an operator has the vehicle
  kBusy,      // an order is being carried out
  kOver,      // its mission has ended, and nobody has left it since
  kSilent,    // it flies, and nothing can be commanded
};
/// For logs and displays.
std::string_view to_string(ModeHindrance hindrance);

/// What is remembered of it from tick to tick.
struct FollowMode {
  double ready_s = -1e18;  // when a plan could have been flown last, by the monotonic clock
  bool over = false;
};

/// The flight controller asks three times a second, and a plan may be late: who selects the mode a
/// moment after it was ready starts it.
inline constexpr double kReadyFor_s = 1.0;

/// `silent`: the gate commands nothing.
ModeHindrance hindrance_of(const FollowMode& mode, const Mission& mission,
                           const AutopilotStatus& status, double now_s, bool silent);

/// The pilot has selected the mode, and it flies: the mission tracks from now on. False: it did not
/// come to that.
bool start_by_pilot(const FollowMode& mode, Mission& mission, const AutopilotStatus& status,
                    double now_s);

/// After the mission's step: a mission that has ended in the mode is not resumed when the flight
/// controller comes back to it by itself, as after a failsafe.
void note_end(FollowMode& mode, bool was_engaged, const Mission& mission,
              const AutopilotStatus& status);

}  // namespace foretrack
