// SPDX-License-Identifier: Apache-2.0
// The simulated vehicle's battery.
#pragma once

#include "core/common/battery_state.hpp"

namespace foretrack {

struct BatteryParams {
  int cells = 4;
  double capacity_ah = 5.0;
  double hover_current_a = 14.0;
  double standing_current_a = 0.8;  // everything but the motors
  double resistance_ohm = 0.02;
  double empty_cell_v = 3.5, full_cell_v = 4.15;         // at rest
  double low = 0.15, critical = 0.07, emergency = 0.05;  // PX4's thresholds
};

struct Battery {
  BatteryParams params;
  double used_ah = 0.0;
  double current_a = 0.0;

  BatteryState state() const;
};

/// The motors' power goes with the thrust to 3/2 (momentum theory), so their current does: relative
/// to hovering, from the acceleration that the vehicle has beside gravity.
void drain(Battery& battery, double acceleration_z_m_s2, double acceleration_xy_m_s2, bool armed,
           double dt_s);

}  // namespace foretrack
