#include "core/simulator/autopilot.hpp"

#include <limits>

namespace foretrack {
namespace {

constexpr double kStanding_m_s = 0.2;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Velocity zero first; a place to hold once nearly still.
void brake(Autopilot& autopilot, const VehicleState& vehicle) {
  Setpoint& s = autopilot.setpoint;
  s = Setpoint{};
  s.position_enu_m.setConstant(kNaN);
  s.yaw_rad = vehicle.yaw_rad();
}

void hold_once_still(Autopilot& autopilot, const VehicleState& vehicle) {
  Setpoint& s = autopilot.setpoint;
  if (s.position_enu_m.hasNaN() && vehicle.velocity_enu_m_s.norm() < kStanding_m_s)
    s.position_enu_m = vehicle.position_enu_m;
}

void hear(Autopilot& autopilot, double now_s) {
  if (now_s - autopilot.heartbeat_last_s > autopilot.params.heartbeat_timeout_s)
    autopilot.heartbeat_since_s = now_s;
  autopilot.heartbeat_last_s = now_s;
}

}  // namespace

Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle) {
  Autopilot autopilot{.params = params, .status = {}, .setpoint = {}};
  autopilot.status = {.stamp_s = vehicle.stamp_s, .armed = true};
  autopilot.setpoint.position_enu_m = vehicle.position_enu_m;
  autopilot.setpoint.yaw_rad = vehicle.yaw_rad();
  return autopilot;
}

const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle) {
  const double now_s = vehicle.stamp_s;
  AutopilotStatus& status = autopilot.status;
  status.stamp_s = now_s;
  if (input.arm) status.armed = *input.arm;
  if (input.heartbeat) hear(autopilot, now_s);
  const bool alive = now_s - autopilot.heartbeat_last_s <= autopilot.params.heartbeat_timeout_s;
  const bool proven =
      alive && now_s - autopilot.heartbeat_since_s >= autopilot.params.heartbeat_needed_s;
  if (status.offboard && (!alive || input.hold)) {
    status.failsafe = !alive;
    status.offboard = false;
    brake(autopilot, vehicle);
  } else if (!status.offboard && input.offboard && proven) {
    status.offboard = true;
    status.failsafe = false;
  }
  if (status.offboard && input.setpoint) autopilot.setpoint = *input.setpoint;
  if (!status.offboard) hold_once_still(autopilot, vehicle);
  return autopilot.setpoint;
}

}  // namespace foretrack
