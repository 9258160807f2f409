// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_health.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "px4_msgs/msg/VehicleStatus.h"
#include "services/convert/px4_time.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;

constexpr std::uint32_t kOffboard = 1u << msg::VehicleStatus_Constants::NAVIGATION_STATE_OFFBOARD;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void to_idl(const BatteryState& in, double stamp_s, msg::BatteryStatus& out) {
  const double left_s = in.time_remaining_s;
  const double full_wh = 3.7 * in.cells * in.capacity_ah;
  out.timestamp(microseconds(stamp_s));
  out.connected(true);
  out.voltage_v(static_cast<float>(in.voltage_v));
  out.current_a(static_cast<float>(in.current_a));
  out.current_average_a(static_cast<float>(in.current_a));
  out.discharged_mah(static_cast<float>(1000.0 * in.used_ah));
  out.remaining(static_cast<float>(in.remaining));
  out.scale(1.0f);
  out.time_remaining_s(std::isfinite(left_s) ? static_cast<float>(left_s) : kUnknown);
  out.temperature(kUnknown);
  out.cell_count(static_cast<std::uint8_t>(in.cells));
  out.capacity(static_cast<std::uint16_t>(1000.0 * in.capacity_ah));
  out.id(1);
  for (int i = 0; i < in.cells; ++i)
    out.voltage_cell_v()[static_cast<std::size_t>(i)] = static_cast<float>(in.voltage_v / in.cells);
  out.is_required(true);
  out.warning(static_cast<std::uint8_t>(in.warning));
  out.nominal_voltage(static_cast<float>(3.7 * in.cells));
  out.internal_resistance_estimate(static_cast<float>(in.resistance_ohm));
  out.full_charge_capacity_wh(static_cast<float>(full_wh));
  out.remaining_capacity_wh(static_cast<float>(full_wh * in.remaining));
}

Converted<BatteryState> from_idl(const msg::BatteryStatus& in) {
  Checks checks;
  if (!in.connected()) checks.fail("connected", "false", "true");
  checks.in_range("remaining", in.remaining(), 0.0, 1.0);
  BatteryState out;
  out.cells = in.cell_count();
  out.capacity_ah = 1e-3 * in.capacity();
  out.used_ah = 1e-3 * std::max(0.0f, in.discharged_mah());
  out.remaining = in.remaining();
  out.voltage_v = in.voltage_v();
  out.current_a = in.current_a();
  out.resistance_ohm = in.internal_resistance_estimate();
  if (std::isfinite(in.time_remaining_s())) out.time_remaining_s = in.time_remaining_s();
  out.warning = static_cast<BatteryWarning>(
      std::min(in.warning(), msg::BatteryStatus_Constants::WARNING_EMERGENCY));
  return checks.result(out);
}

bool is_of_our_making(const msg::FailsafeFlags& f, bool was) {
  const bool guards = f.geofence_breached() || f.battery_unhealthy() || f.fd_critical_failure() ||
                      f.fd_motor_failure() || f.fd_esc_arming_failure() ||
                      f.local_position_invalid() ||
                      f.battery_warning() >= msg::BatteryStatus_Constants::WARNING_CRITICAL;
  return (f.offboard_control_signal_lost() || was) && !guards;
}

void to_flags(double stamp_s, bool offboard_possible, BatteryWarning warning, bool trouble,
              msg::FailsafeFlags& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.mode_req_angular_velocity(kOffboard);
  out.mode_req_attitude(kOffboard);
  out.mode_req_local_alt(kOffboard);
  out.mode_req_local_position(kOffboard);
  out.mode_req_offboard_signal(kOffboard);
  out.mode_req_home_position(1u << msg::VehicleStatus_Constants::NAVIGATION_STATE_AUTO_RTL);
  out.offboard_control_signal_lost(!offboard_possible);
  out.geofence_breached(trouble);
  out.auto_mission_missing(true);
  out.global_position_invalid(true);  // it flies by its local one
  out.battery_warning(static_cast<std::uint8_t>(warning));
}

std::string what_hinders_offboard(const msg::FailsafeFlags& f) {
  std::string text;
  const auto add = [&text](bool hinders, const char* what) {
    if (hinders) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  const auto needed = [&add](std::uint32_t modes, bool missing, const char* what) {
    add(missing && (modes & kOffboard) != 0, what);
  };
  needed(f.mode_req_offboard_signal(), f.offboard_control_signal_lost(), "no offboard signal");
  needed(f.mode_req_local_position(), f.local_position_invalid(), "no local position");
  needed(f.mode_req_local_position_relaxed(), f.local_position_invalid_relaxed(),
         "no local position, not even a coarse one");
  needed(f.mode_req_local_alt(), f.local_altitude_invalid(), "no local altitude");
  needed(f.mode_req_global_position(), f.global_position_invalid(), "no global position");
  needed(f.mode_req_home_position(), f.home_position_invalid(), "no home position");
  needed(f.mode_req_attitude(), f.attitude_invalid(), "no attitude");
  needed(f.mode_req_angular_velocity(), f.angular_velocity_invalid(), "no angular velocity");
  needed(f.mode_req_manual_control(), f.manual_control_signal_lost(), "no remote control");
  needed(f.mode_req_prevent_arming(), true, "offboard mode cannot arm");
  needed(f.mode_req_other(), true, "another requirement of offboard mode");
  add(f.battery_unhealthy(), "the battery is unhealthy");
  add(f.battery_warning() >= msg::BatteryStatus_Constants::WARNING_CRITICAL,
      "the battery is critical");
  add(f.geofence_breached(), "outside of the geofence");
  add(f.fd_critical_failure() || f.fd_motor_failure() || f.fd_esc_arming_failure(),
      "a failure of the vehicle");
  return text;
}

}  // namespace foretrack
