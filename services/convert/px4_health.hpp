// SPDX-License-Identifier: Apache-2.0
// What the flight controller says of its battery, and of why it would refuse offboard mode.
#pragma once

#include <string>

#include "core/common/battery_state.hpp"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"

namespace foretrack {

void to_idl(const BatteryState& battery, double stamp_s, px4_msgs::msg::BatteryStatus& out);

/// Flags of a vehicle whose estimates are all well. Offboard mode needs its signal and a local
/// position; what flies by itself needs a home.
void to_flags(double stamp_s, bool offboard_possible, BatteryWarning warning,
              px4_msgs::msg::FailsafeFlags& out);

/// What offboard mode needs and has not got, and what hinders arming: "no offboard signal, no local
/// position". Empty: nothing.
std::string what_hinders_offboard(const px4_msgs::msg::FailsafeFlags& flags);

}  // namespace foretrack
