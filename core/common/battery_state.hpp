// SPDX-License-Identifier: Apache-2.0
// What the flight controller says of the vehicle's battery.
#pragma once

#include <cstdint>
#include <limits>

namespace foretrack {

/// How urgent it is to land. The flight controller decides it; the order is from least to most.
enum class BatteryWarning : std::uint8_t { kNone, kLow, kCritical, kEmergency };

/// One report of the flight controller.
struct BatteryState {
  int cells = 0;                ///< in series; 0: not known
  double capacity_ah = 0.0;     ///< when full
  double used_ah = 0.0;         ///< since it was full
  double remaining = 1.0;       ///< share of the capacity that is left, 0 to 1
  double voltage_v = 0.0;       ///< of the whole battery, under the present load
  double current_a = 0.0;       ///< drawn now; positive: the battery empties
  double resistance_ohm = 0.0;  ///< inside the battery: the voltage falls by it times the current
  /// Until it is empty, at the present load. Infinity: no load, or not known.
  double time_remaining_s = std::numeric_limits<double>::infinity();
  BatteryWarning warning = BatteryWarning::kNone;
};

}  // namespace foretrack
