// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/autopilot.hpp"

#include <algorithm>
#include <limits>

namespace foretrack {
namespace {

constexpr double kStanding_m_s = 0.2;
constexpr double kArrived_m = 0.3;
constexpr double kGround_m = 0.05;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void hear(Autopilot& autopilot, double now_s) {
  if (now_s - autopilot.heartbeat_last_s > autopilot.params.heartbeat_timeout_s)
    autopilot.heartbeat_since_s = now_s;
  autopilot.heartbeat_last_s = now_s;
}

bool is_alive(const Autopilot& autopilot, double now_s) {
  return now_s - autopilot.heartbeat_last_s <= autopilot.params.heartbeat_timeout_s;
}

FlightMode named(AutopilotMode mode) {
  constexpr FlightMode modes[] = {FlightMode::kHold, FlightMode::kOffboard, FlightMode::kReturn,
                                  FlightMode::kLand};
  return modes[static_cast<int>(mode)];
}

// Velocity zero first; a place to hold once nearly still.
void enter(Autopilot& autopilot, AutopilotMode mode, const VehicleState& vehicle) {
  autopilot.mode = mode;
  autopilot.status.offboard = mode == AutopilotMode::kOffboard;
  autopilot.status.mode = named(mode);
  autopilot.setpoint = Setpoint{};
  autopilot.setpoint.position_enu_m.setConstant(kNaN);
  autopilot.setpoint.yaw_rad = vehicle.yaw_rad();
}

void switch_mode(Autopilot& autopilot, const AutopilotInput& input, const VehicleState& vehicle) {
  const double now_s = vehicle.stamp_s;
  const bool alive = is_alive(autopilot, now_s);
  if (autopilot.mode == AutopilotMode::kOffboard && !alive) {
    autopilot.status.failsafe = true;
    return enter(autopilot, AutopilotMode::kHold, vehicle);
  }
  if (!input.mode || *input.mode == autopilot.mode) return;
  if (*input.mode == AutopilotMode::kOffboard && !may_fly_offboard(autopilot, now_s)) return;
  autopilot.status.failsafe = false;
  enter(autopilot, *input.mode, vehicle);
}

void hold(Setpoint& setpoint, const VehicleState& vehicle) {
  if (setpoint.position_enu_m.hasNaN() && vehicle.velocity_enu_m_s.norm() < kStanding_m_s)
    setpoint.position_enu_m = vehicle.position_enu_m;
}

void land(Autopilot& autopilot, const VehicleState& vehicle) {
  Setpoint& s = autopilot.setpoint;
  s.velocity_enu_m_s = -autopilot.params.land_speed_m_s * Vec3::UnitZ();
  if (std::isnan(s.position_enu_m.x())) s.position_enu_m = vehicle.position_enu_m;
  s.position_enu_m.z() = kNaN;
  if (vehicle.position_enu_m.z() < kGround_m) autopilot.status.armed = false;
}

void return_home(Autopilot& autopilot, const VehicleState& vehicle, double dt_s) {
  Vec3& place = autopilot.setpoint.position_enu_m;
  if (place.hasNaN()) place = vehicle.position_enu_m;
  const Vec2 left = (autopilot.home_enu_m - place).head<2>();
  const double step_m = std::min(left.norm(), autopilot.params.return_speed_m_s * dt_s);
  if (step_m > 0.0) place.head<2>() += step_m * left.normalized();
  if (distance_xy(vehicle.position_enu_m, autopilot.home_enu_m) < kArrived_m)
    enter(autopilot, AutopilotMode::kLand, vehicle);
}

}  // namespace

Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle) {
  Autopilot autopilot{.params = params, .status = {}, .setpoint = {}};
  autopilot.status = {.stamp_s = vehicle.stamp_s, .armed = true, .mode = FlightMode::kHold};
  autopilot.home_enu_m = vehicle.position_enu_m;
  autopilot.setpoint.position_enu_m = vehicle.position_enu_m;
  autopilot.setpoint.yaw_rad = vehicle.yaw_rad();
  return autopilot;
}

bool may_fly_offboard(const Autopilot& autopilot, double now_s) {
  return is_alive(autopilot, now_s) &&
         now_s - autopilot.heartbeat_since_s >= autopilot.params.heartbeat_needed_s;
}

const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle, double dt_s) {
  autopilot.status.stamp_s = vehicle.stamp_s;
  if (input.arm) autopilot.status.armed = *input.arm;
  if (input.heartbeat) hear(autopilot, vehicle.stamp_s);
  switch_mode(autopilot, input, vehicle);
  switch (autopilot.mode) {
    case AutopilotMode::kHold:
      hold(autopilot.setpoint, vehicle);
      break;
    case AutopilotMode::kOffboard:
      if (input.setpoint) autopilot.setpoint = *input.setpoint;
      break;
    case AutopilotMode::kReturn:
      return_home(autopilot, vehicle, dt_s);
      break;
    case AutopilotMode::kLand:
      land(autopilot, vehicle);
      break;
  }
  return autopilot.setpoint;
}

}  // namespace foretrack
