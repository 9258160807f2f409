// SPDX-License-Identifier: Apache-2.0
// The simulated vehicle's battery.
#pragma once

#include "core/common/battery_state.hpp"

namespace foretrack {

/// A lithium battery for about 20 minutes of hovering.
struct BatteryParams {
  int cells = 4;
  double capacity_ah = 5.0;
  double hover_current_a = 14.0;
  double standing_current_a = 0.8;  ///< of everything but the motors
  double resistance_ohm = 0.02;
  double empty_cell_v = 3.5;  ///< of a cell at rest
  double full_cell_v = 4.15;  ///< of a cell at rest; between both, linear in what is left
  double low = 0.15, critical = 0.07, emergency = 0.05;  ///< shares left; PX4's thresholds
};

/// A battery as it is now.
struct Battery {
  BatteryParams params;
  double used_ah = 0.0;
  double current_a = 0.0;  ///< in the last step

  /// As a flight controller reports it.
  BatteryState state() const;
};

/// Takes out of the battery what dt_s of flight cost. The motors' power grows as the thrust to the
/// power of 3/2 (momentum theory), and so does their current. The thrust, relative to that of
/// hovering, follows from the vehicle's acceleration (world, without gravity).
void drain(Battery& battery, double acceleration_z_m_s2, double acceleration_xy_m_s2, bool armed,
           double dt_s);

}  // namespace foretrack
