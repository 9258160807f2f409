// SPDX-License-Identifier: Apache-2.0
// What the flight controller says of the vehicle's battery.
#pragma once

#include <cstdint>
#include <limits>

namespace foretrack {

enum class BatteryWarning : std::uint8_t { kNone, kLow, kCritical, kEmergency };

struct BatteryState {
  int cells = 0;
  double capacity_ah = 0.0;
  double used_ah = 0.0;
  double remaining = 1.0;  // share, 0 to 1
  double voltage_v = 0.0;  // under the present load
  double current_a = 0.0;
  double resistance_ohm = 0.0;
  double time_remaining_s = std::numeric_limits<double>::infinity();  // at the present load
  BatteryWarning warning = BatteryWarning::kNone;
};

}  // namespace foretrack
