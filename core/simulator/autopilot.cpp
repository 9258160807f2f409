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

bool is_on_ground(const VehicleState& vehicle) {
  return vehicle.position_enu_m.z() < kGround_m;
}

void hear(Autopilot& autopilot, double now_s) {
  if (now_s - autopilot.heartbeat_last_s > autopilot.params.heartbeat_timeout_s)
    autopilot.heartbeat_since_s = now_s;
  autopilot.heartbeat_last_s = now_s;
}

bool is_alive(const Autopilot& autopilot, double now_s) {
  return now_s - autopilot.heartbeat_last_s <= autopilot.params.heartbeat_timeout_s;
}

// Velocity zero first; a place to hold once nearly still.
void enter(Autopilot& autopilot, FlightMode mode, const VehicleState& vehicle) {
  autopilot.status.mode = mode;
  autopilot.status.offboard = mode == FlightMode::kOffboard;
  autopilot.setpoint = Setpoint{};
  autopilot.setpoint.position_enu_m.setConstant(kNaN);
  autopilot.setpoint.yaw_rad = vehicle.yaw_rad();
}

bool can_run(const Autopilot& autopilot, FlightMode mode, double now_s) {
  return mode != FlightMode::kOffboard || may_fly_offboard(autopilot, now_s);
}

// A pilot's or a command's wish, which PX4 does not tell apart.
bool change_mode(Autopilot& autopilot, FlightMode mode, const VehicleState& vehicle) {
  AutopilotStatus& status = autopilot.status;
  if (status.mode == FlightMode::kTermination) return false;
  if (status.armed && !can_run(autopilot, mode, vehicle.stamp_s)) return false;
  if (status.failsafe) status.user_took_over = autopilot.trouble;
  status.failsafe = false;
  autopilot.user_mode = mode;
  if (mode != status.mode) enter(autopilot, mode, vehicle);
  return true;
}

void set_armed(Autopilot& autopilot, bool armed, const VehicleState& vehicle) {
  AutopilotStatus& status = autopilot.status;
  if (status.armed == armed) return;
  status.armed = armed;
  status.failsafe = status.user_took_over = false;
  autopilot.grounded_since_s = vehicle.stamp_s;
  if (armed) autopilot.home_enu_m = vehicle.position_enu_m;
  if (armed || status.mode == FlightMode::kTermination) return;
  autopilot.user_mode = FlightMode::kHold;
  enter(autopilot, FlightMode::kHold, vehicle);
}

bool arm(Autopilot& autopilot, const VehicleState& vehicle) {
  const FlightMode mode = autopilot.status.mode;
  if (autopilot.status.armed) return true;
  if (mode == FlightMode::kTermination || autopilot.trouble) return false;
  if (!can_run(autopilot, mode, vehicle.stamp_s)) return false;
  set_armed(autopilot, true, vehicle);
  return true;
}

bool disarm(Autopilot& autopilot, bool forced, const VehicleState& vehicle) {
  if (!forced && !is_on_ground(vehicle)) return false;
  set_armed(autopilot, false, vehicle);
  return true;
}

std::optional<CommandResult> take_home(Autopilot& autopilot, const Vec3& home_enu_m) {
  if (autopilot.manner == Autopilot::Manner::kIgnores) return std::nullopt;
  if (autopilot.manner == Autopilot::Manner::kDenies) return CommandResult::kDenied;
  autopilot.home_enu_m.head<2>() = home_enu_m.head<2>();
  return CommandResult::kAccepted;
}

std::optional<CommandResult> obey(Autopilot& autopilot, const AutopilotCommand& command,
                                  const VehicleState& vehicle) {
  const bool is_ours =
      command.target_system == 0 || command.target_system == autopilot.status.system_id;
  if (!is_ours || autopilot.manner == Autopilot::Manner::kIgnores) return std::nullopt;
  if (autopilot.manner == Autopilot::Manner::kDenies) return CommandResult::kDenied;
  bool done = false;
  switch (command.kind) {
    case CommandKind::kArm:
      done = arm(autopilot, vehicle);
      break;
    case CommandKind::kDisarm:
      done = disarm(autopilot, command.forced, vehicle);
      break;
    case CommandKind::kMode:
      done = change_mode(autopilot, command.mode, vehicle);
      break;
  }
  return done ? CommandResult::kAccepted : CommandResult::kTemporarilyRejected;
}

// What the user wished for waits until the trouble is over.
void fail_safe(Autopilot& autopilot, FlightMode mode, const VehicleState& vehicle) {
  AutopilotStatus& status = autopilot.status;
  autopilot.trouble = true;
  if (!status.armed || status.mode == FlightMode::kTermination) return;
  status.failsafe = true;
  status.user_took_over = false;
  if (mode != status.mode) enter(autopilot, mode, vehicle);
}

void end_trouble(Autopilot& autopilot, const VehicleState& vehicle) {
  AutopilotStatus& status = autopilot.status;
  const bool back = status.failsafe && autopilot.user_mode != status.mode;
  autopilot.trouble = status.failsafe = status.user_took_over = false;
  if (back) enter(autopilot, autopilot.user_mode, vehicle);
}

void suffer(Autopilot& autopilot, const Incident& incident, const VehicleState& vehicle) {
  switch (incident.kind) {
    case IncidentKind::kMode:
      change_mode(autopilot, incident.mode, vehicle);
      break;
    case IncidentKind::kSticks:
      autopilot.status.sticks_moved = true;
      change_mode(autopilot, FlightMode::kPilot, vehicle);
      break;
    case IncidentKind::kDisarm:
      disarm(autopilot, true, vehicle);
      break;
    case IncidentKind::kGeofence:
      fail_safe(autopilot, FlightMode::kHold, vehicle);
      break;
    case IncidentKind::kBattery:
    case IncidentKind::kLink:
      fail_safe(autopilot, FlightMode::kReturn, vehicle);
      break;
    case IncidentKind::kWell:
      end_trouble(autopilot, vehicle);
      break;
    case IncidentKind::kTerminate:
      autopilot.status.failsafe = true;
      enter(autopilot, FlightMode::kTermination, vehicle);
      break;
    case IncidentKind::kDeny:
      autopilot.manner = Autopilot::Manner::kDenies;
      break;
    case IncidentKind::kIgnore:
      autopilot.manner = Autopilot::Manner::kIgnores;
      break;
    case IncidentKind::kObey:
      autopilot.manner = Autopilot::Manner::kObeys;
      break;
  }
}

void suffer_what_is_due(Autopilot& autopilot, const VehicleState& vehicle) {
  const auto& incidents = autopilot.params.incidents;
  std::size_t& next = autopilot.incidents_passed;
  for (; next < incidents.size() && incidents[next].at_s <= vehicle.stamp_s; ++next)
    suffer(autopilot, incidents[next], vehicle);
}

void watch_heartbeat(Autopilot& autopilot, const VehicleState& vehicle) {
  if (!autopilot.status.offboard || !autopilot.status.armed) return;
  if (is_alive(autopilot, vehicle.stamp_s)) return;
  autopilot.status.failsafe = true;
  autopilot.user_mode = FlightMode::kHold;
  enter(autopilot, FlightMode::kHold, vehicle);
}

void watch_ground(Autopilot& autopilot, const VehicleState& vehicle) {
  if (!is_on_ground(vehicle)) autopilot.grounded_since_s = vehicle.stamp_s;
  if (vehicle.stamp_s - autopilot.grounded_since_s > autopilot.params.unflown_s)
    set_armed(autopilot, false, vehicle);
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
  if (is_on_ground(vehicle)) set_armed(autopilot, false, vehicle);
}

void return_home(Autopilot& autopilot, const VehicleState& vehicle, double dt_s) {
  Vec3& place = autopilot.setpoint.position_enu_m;
  if (place.hasNaN()) place = vehicle.position_enu_m;
  const Vec2 left = (autopilot.home_enu_m - place).head<2>();
  const double step_m = std::min(left.norm(), autopilot.params.return_speed_m_s * dt_s);
  if (step_m > 0.0) place.head<2>() += step_m * left.normalized();
  if (distance_xy(vehicle.position_enu_m, autopilot.home_enu_m) < kArrived_m)
    enter(autopilot, FlightMode::kLand, vehicle);
}

void take_off(Autopilot& autopilot, const VehicleState& vehicle, double dt_s) {
  Vec3& place = autopilot.setpoint.position_enu_m;
  if (place.hasNaN() || !autopilot.status.armed) place = vehicle.position_enu_m;
  const double top_m = autopilot.home_enu_m.z() + autopilot.params.takeoff_height_m;
  place.z() = std::min(place.z() + autopilot.params.takeoff_speed_m_s * dt_s, top_m);
  if (vehicle.position_enu_m.z() < top_m - kArrived_m) return;
  autopilot.user_mode = FlightMode::kHold;
  enter(autopilot, FlightMode::kHold, vehicle);
}

}  // namespace

Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle) {
  Autopilot autopilot{.params = params, .status = {}, .setpoint = {}, .answer = {}};
  autopilot.status = {.stamp_s = vehicle.stamp_s,
                      .armed = !is_on_ground(vehicle),
                      .mode = FlightMode::kHold,
                      .system_id = params.system_id};
  autopilot.home_enu_m = vehicle.position_enu_m;
  autopilot.setpoint.position_enu_m = vehicle.position_enu_m;
  autopilot.setpoint.yaw_rad = vehicle.yaw_rad();
  return autopilot;
}

bool may_fly_offboard(const Autopilot& autopilot, double now_s) {
  return is_alive(autopilot, now_s) &&
         now_s - autopilot.heartbeat_since_s >= autopilot.params.heartbeat_needed_s;
}

bool motors_turn(const Autopilot& autopilot) {
  return autopilot.status.armed && autopilot.status.mode != FlightMode::kTermination;
}

const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle, double dt_s) {
  autopilot.status.stamp_s = vehicle.stamp_s;
  autopilot.answer.reset();
  autopilot.status.sticks_moved = false;
  if (input.heartbeat) hear(autopilot, vehicle.stamp_s);
  suffer_what_is_due(autopilot, vehicle);
  watch_heartbeat(autopilot, vehicle);
  if (input.command) autopilot.answer = obey(autopilot, *input.command, vehicle);
  if (input.home_enu_m) autopilot.answer = take_home(autopilot, *input.home_enu_m);
  watch_ground(autopilot, vehicle);
  switch (autopilot.status.mode) {
    case FlightMode::kOffboard:
      if (input.setpoint) autopilot.setpoint = *input.setpoint;
      break;
    case FlightMode::kTakeOff:
      take_off(autopilot, vehicle, dt_s);
      break;
    case FlightMode::kReturn:
      return_home(autopilot, vehicle, dt_s);
      break;
    case FlightMode::kLand:
      land(autopilot, vehicle);
      break;
    default:  // whoever flies holds the place
      hold(autopilot.setpoint, vehicle);
      break;
  }
  return autopilot.setpoint;
}

}  // namespace foretrack
