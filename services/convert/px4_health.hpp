// SPDX-License-Identifier: Apache-2.0
// What the flight controller says of its battery, and of why it would refuse offboard mode.
#pragma once

#include <string>

#include "core/common/battery_state.hpp"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const BatteryState& battery, double stamp_s, px4_msgs::msg::BatteryStatus& out);
/// A battery that is not connected, or whose charge is not known, is a fault.
Converted<BatteryState> from_idl(const px4_msgs::msg::BatteryStatus& in);

/// Flags of a vehicle whose estimates are all well. Offboard mode needs its signal and a local
/// position; what flies by itself needs a home. `trouble`: it is outside of its geofence.
void to_flags(double stamp_s, bool offboard_possible, BatteryWarning warning, bool trouble,
              px4_msgs::msg::FailsafeFlags& out);

/// The lost offboard signal alone can be what a failsafe acts for: we were silent ourselves, and a
/// request for a mode cancels nothing that guards the vehicle. `was`: the failsafe that still acts
/// was so when the signal was lost; the flags forget it as soon as the signal is back.
bool is_of_our_making(const px4_msgs::msg::FailsafeFlags& flags, bool was = false);

/// What offboard mode needs and has not got, and what hinders arming: "no offboard signal, no local
/// position". Empty: nothing.
std::string what_hinders_offboard(const px4_msgs::msg::FailsafeFlags& flags);

}  // namespace foretrack
