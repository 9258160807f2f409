// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/battery.hpp"

#include <algorithm>
#include <cmath>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

BatteryWarning warning_at(double remaining, const BatteryParams& p) {
  if (remaining < p.emergency) return BatteryWarning::kEmergency;
  if (remaining < p.critical) return BatteryWarning::kCritical;
  return remaining < p.low ? BatteryWarning::kLow : BatteryWarning::kNone;
}

}  // namespace

BatteryState Battery::state() const {
  BatteryState s;
  s.cells = params.cells;
  s.capacity_ah = params.capacity_ah;
  s.used_ah = used_ah;
  s.remaining = std::clamp(1.0 - used_ah / params.capacity_ah, 0.0, 1.0);
  const double cell_v =
      params.empty_cell_v + s.remaining * (params.full_cell_v - params.empty_cell_v);
  s.voltage_v = params.cells * cell_v - params.resistance_ohm * current_a;
  s.current_a = current_a;
  s.resistance_ohm = params.resistance_ohm;
  if (current_a > 0.0) s.time_remaining_s = 3600.0 * s.remaining * s.capacity_ah / current_a;
  s.warning = warning_at(s.remaining, params);
  return s;
}

void drain(Battery& battery, double acceleration_z_m_s2, double acceleration_xy_m_s2, bool armed,
           double dt_s) {
  const double up = std::max(0.0, 1.0 + acceleration_z_m_s2 / kGravity_m_s2);
  const double thrust = std::hypot(up, acceleration_xy_m_s2 / kGravity_m_s2);  // hovering: 1
  const BatteryParams& p = battery.params;
  const double motors_a = armed ? p.hover_current_a * std::pow(thrust, 1.5) : 0.0;
  battery.current_a = p.standing_current_a + motors_a;
  battery.used_ah += battery.current_a * dt_s / 3600.0;
}

}  // namespace foretrack
