// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4.hpp"

#include <limits>
#include <string>

#include "core/common/frames.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;
namespace command = msg::VehicleCommand_Constants;
namespace odometry = msg::VehicleOdometry_Constants;
namespace vehicle = msg::VehicleStatus_Constants;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kCustomModeEnabled = 1.0f;  // of VEHICLE_CMD_DO_SET_MODE
constexpr float kOffboardMainMode = 6.0f;   // PX4_CUSTOM_MAIN_MODE_OFFBOARD
constexpr float kAutoMainMode = 4.0f;       // PX4_CUSTOM_MAIN_MODE_AUTO
constexpr float kLoiterSubMode = 3.0f;      // PX4_CUSTOM_SUB_MODE_AUTO_LOITER
// Of VehicleStatus.nav_state, PX4 1.16: other ways in which a pilot flies.
constexpr std::uint8_t kPositionSlow = 6, kAltitudeCruise = 8, kAcro = 10, kStabilized = 15;
constexpr std::uint8_t kAutopilotComponent = 1;
constexpr double kMaxStamp_s = 1e10;

std::uint64_t microseconds(double stamp_s) {
  return static_cast<std::uint64_t>(std::llround(stamp_s * 1e6));
}
double read_stamp(Checks& checks, std::uint64_t timestamp_us) {
  const double stamp_s = 1e-6 * static_cast<double>(timestamp_us);
  checks.in_range("timestamp", stamp_s, 0.0, kMaxStamp_s);
  return stamp_s;
}

std::array<float, 3> to_ned(const Vec3& enu) {
  return to_floats(swap_enu_ned(enu));
}
Vec3 from_ned(const std::array<float, 3>& ned) {
  return swap_enu_ned(to_vec3(ned));
}
void no_infinities(Checks& checks, std::string_view field, const std::array<float, 3>& values) {
  for (const float v : values)
    if (std::isinf(v)) checks.fail(field, std::to_string(v), "a number or NaN");
}

FlightMode mode_of(std::uint8_t nav_state) {
  switch (nav_state) {
    case vehicle::NAVIGATION_STATE_OFFBOARD:
      return FlightMode::kOffboard;
    case vehicle::NAVIGATION_STATE_AUTO_LOITER:
      return FlightMode::kHold;
    case vehicle::NAVIGATION_STATE_AUTO_TAKEOFF:
      return FlightMode::kTakeOff;
    case vehicle::NAVIGATION_STATE_AUTO_RTL:
      return FlightMode::kReturn;
    case vehicle::NAVIGATION_STATE_AUTO_LAND:
      return FlightMode::kLand;
    case vehicle::NAVIGATION_STATE_TERMINATION:
      return FlightMode::kTermination;
    case vehicle::NAVIGATION_STATE_MANUAL:
    case vehicle::NAVIGATION_STATE_ALTCTL:
    case vehicle::NAVIGATION_STATE_POSCTL:
    case kPositionSlow:
    case kAltitudeCruise:
    case kAcro:
    case kStabilized:
      return FlightMode::kPilot;
    default:
      return FlightMode::kOther;
  }
}

std::uint8_t nav_state_of(const AutopilotStatus& status) {
  switch (status.mode) {
    case FlightMode::kPilot:
      return vehicle::NAVIGATION_STATE_POSCTL;
    case FlightMode::kTakeOff:
      return vehicle::NAVIGATION_STATE_AUTO_TAKEOFF;
    case FlightMode::kReturn:
      return vehicle::NAVIGATION_STATE_AUTO_RTL;
    case FlightMode::kLand:
      return vehicle::NAVIGATION_STATE_AUTO_LAND;
    case FlightMode::kTermination:
      return vehicle::NAVIGATION_STATE_TERMINATION;
    case FlightMode::kOther:
      return vehicle::NAVIGATION_STATE_AUTO_MISSION;
    case FlightMode::kUnknown:
    case FlightMode::kOffboard:
    case FlightMode::kHold:
      break;
  }
  return status.offboard ? vehicle::NAVIGATION_STATE_OFFBOARD
                         : vehicle::NAVIGATION_STATE_AUTO_LOITER;
}

Quat quaternion(const std::array<float, 4>& wxyz) {
  return Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
}

}  // namespace

void to_idl(const Setpoint& in, msg::TrajectorySetpoint& out) {
  out.timestamp(microseconds(in.stamp_s));
  out.position(to_ned(in.position_enu_m));
  out.velocity(to_ned(in.velocity_enu_m_s));
  out.acceleration(to_ned(in.acceleration_enu_m_s2));
  out.jerk(to_ned(in.jerk_enu_m_s3));
  out.yaw(static_cast<float>(swap_yaw_enu_ned(in.yaw_rad)));
  out.yawspeed(static_cast<float>(swap_yaw_rate_enu_ned(in.yaw_rate_rad_s)));
}

Converted<Setpoint> from_idl(const msg::TrajectorySetpoint& in) {
  Checks checks;
  Setpoint out;
  out.stamp_s = read_stamp(checks, in.timestamp());
  no_infinities(checks, "position", in.position());
  no_infinities(checks, "velocity", in.velocity());
  no_infinities(checks, "acceleration", in.acceleration());
  no_infinities(checks, "jerk", in.jerk());
  no_infinities(checks, "yaw", {in.yaw(), in.yawspeed(), 0.0f});
  out.position_enu_m = from_ned(in.position());
  out.velocity_enu_m_s = from_ned(in.velocity());
  out.acceleration_enu_m_s2 = from_ned(in.acceleration());
  out.jerk_enu_m_s3 = from_ned(in.jerk());
  out.yaw_rad = swap_yaw_enu_ned(in.yaw());
  out.yaw_rate_rad_s = swap_yaw_rate_enu_ned(in.yawspeed());
  return checks.result(out);
}

void to_heartbeat(double stamp_s, msg::OffboardControlMode& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.position(true);
}

void to_idl(const VehicleState& in, msg::VehicleOdometry& out) {
  const Quat q = swap_attitude_enu_ned(in.q_world_body);
  out.timestamp(microseconds(in.stamp_s));
  out.timestamp_sample(microseconds(in.stamp_s));
  out.pose_frame(odometry::POSE_FRAME_NED);
  out.position(to_ned(in.position_enu_m));
  out.q({static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
         static_cast<float>(q.z())});
  out.velocity_frame(odometry::VELOCITY_FRAME_NED);
  out.velocity(to_ned(in.velocity_enu_m_s));
  out.angular_velocity(to_floats(swap_flu_frd(in.angular_velocity_body_rad_s)));
  out.position_variance({kNaN, kNaN, kNaN});
  out.orientation_variance({kNaN, kNaN, kNaN});
  out.velocity_variance({kNaN, kNaN, kNaN});
}

Converted<VehicleState> from_idl(const msg::VehicleOdometry& in) {
  Checks checks;
  VehicleState out;
  out.stamp_s = read_stamp(checks, in.timestamp_sample());
  if (in.pose_frame() != odometry::POSE_FRAME_NED)
    checks.fail("pose_frame", std::to_string(in.pose_frame()), "1 (NED)");
  const bool in_body = in.velocity_frame() == odometry::VELOCITY_FRAME_BODY_FRD;
  if (in.velocity_frame() != odometry::VELOCITY_FRAME_NED && !in_body)
    checks.fail("velocity_frame", std::to_string(in.velocity_frame()), "1 (NED) or 3 (body)");
  checks.within("position", in.position(), limits::kPosition_m);
  checks.within("velocity", in.velocity(), limits::kSpeed_m_s);
  checks.within("angular_velocity", in.angular_velocity(), limits::kRate_rad_s);
  checks.unit("q", quaternion(in.q()).norm());
  if (!checks.ok()) return checks.result(out);
  out.position_enu_m = from_ned(in.position());
  out.q_world_body = swap_attitude_enu_ned(quaternion(in.q()).normalized());
  out.velocity_enu_m_s = in_body ? Vec3(out.q_world_body * swap_flu_frd(to_vec3(in.velocity())))
                                 : from_ned(in.velocity());
  out.angular_velocity_body_rad_s = swap_flu_frd(to_vec3(in.angular_velocity()));
  return checks.result(out);
}

void to_idl(const AutopilotStatus& in, msg::VehicleStatus& out) {
  out.timestamp(microseconds(in.stamp_s));
  out.arming_state(in.armed ? vehicle::ARMING_STATE_ARMED : vehicle::ARMING_STATE_DISARMED);
  out.nav_state(nav_state_of(in));
  out.failsafe(in.failsafe);
  out.failsafe_and_user_took_over(in.user_took_over);
  out.pre_flight_checks_pass(true);
}

Converted<AutopilotStatus> from_idl(const msg::VehicleStatus& in) {
  Checks checks;
  AutopilotStatus out;
  out.stamp_s = read_stamp(checks, in.timestamp());
  checks.enumerator("arming_state", in.arming_state(), vehicle::ARMING_STATE_ARMED);
  out.armed = in.arming_state() == vehicle::ARMING_STATE_ARMED;
  out.offboard = in.nav_state() == vehicle::NAVIGATION_STATE_OFFBOARD;
  out.mode = mode_of(in.nav_state());
  out.failsafe = in.failsafe();
  out.user_took_over = in.failsafe_and_user_took_over();
  return checks.result(out);
}

void to_idl(const VehicleState& in, msg::VehicleLocalPosition& out) {
  const auto position = to_ned(in.position_enu_m), velocity = to_ned(in.velocity_enu_m_s);
  out.timestamp(microseconds(in.stamp_s));
  out.timestamp_sample(microseconds(in.stamp_s));
  out.xy_valid(true);
  out.z_valid(true);
  out.v_xy_valid(true);
  out.v_z_valid(true);
  out.x(position[0]);
  out.y(position[1]);
  out.z(position[2]);
  out.vx(velocity[0]);
  out.vy(velocity[1]);
  out.vz(velocity[2]);
  out.z_deriv(velocity[2]);
  out.heading(static_cast<float>(swap_yaw_enu_ned(in.yaw_rad())));
  out.heading_good_for_control(true);
}

void to_idl(AutopilotRequest request, double stamp_s, msg::VehicleCommand& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.target_system(1);
  out.target_component(kAutopilotComponent);
  out.source_system(1);
  out.source_component(kAutopilotComponent);
  out.from_external(true);
  switch (request) {
    case AutopilotRequest::kNone:
      break;
    case AutopilotRequest::kArm:
      out.command(command::VEHICLE_CMD_COMPONENT_ARM_DISARM);
      out.param1(1.0f);
      break;
    case AutopilotRequest::kOffboard:
      out.command(command::VEHICLE_CMD_DO_SET_MODE);
      out.param1(kCustomModeEnabled);
      out.param2(kOffboardMainMode);
      break;
    case AutopilotRequest::kReturn:
      out.command(command::VEHICLE_CMD_NAV_RETURN_TO_LAUNCH);
      break;
    case AutopilotRequest::kLand:
      out.command(command::VEHICLE_CMD_NAV_LAND);
      break;
    case AutopilotRequest::kTakeOff:
      out.command(command::VEHICLE_CMD_NAV_TAKEOFF);
      out.param7(kNaN);  // as high as it takes off by itself
      break;
    case AutopilotRequest::kHold:
      out.command(command::VEHICLE_CMD_DO_SET_MODE);
      out.param1(kCustomModeEnabled);
      out.param2(kAutoMainMode);
      out.param3(kLoiterSubMode);
      break;
  }
}

namespace {

AutopilotRequest read_mode(Checks& checks, const msg::VehicleCommand& in) {
  if (in.param2() == kOffboardMainMode) return AutopilotRequest::kOffboard;
  if (in.param2() != kAutoMainMode || in.param3() != kLoiterSubMode)
    checks.fail("param2", std::to_string(in.param2()), "6 (offboard), or 4 with 3 (hold)");
  return AutopilotRequest::kHold;
}

}  // namespace

Converted<AutopilotRequest> from_idl(const msg::VehicleCommand& in) {
  Checks checks;
  read_stamp(checks, in.timestamp());
  AutopilotRequest out = AutopilotRequest::kNone;
  switch (in.command()) {
    case command::VEHICLE_CMD_COMPONENT_ARM_DISARM:
      if (in.param1() != 1.0f) checks.fail("param1", std::to_string(in.param1()), "1 (arm)");
      out = AutopilotRequest::kArm;
      break;
    case command::VEHICLE_CMD_DO_SET_MODE:
      out = read_mode(checks, in);
      break;
    case command::VEHICLE_CMD_NAV_RETURN_TO_LAUNCH:
      out = AutopilotRequest::kReturn;
      break;
    case command::VEHICLE_CMD_NAV_LAND:
      out = AutopilotRequest::kLand;
      break;
    case command::VEHICLE_CMD_NAV_TAKEOFF:
      out = AutopilotRequest::kTakeOff;
      break;
    default:
      checks.fail("command", std::to_string(in.command()), "20, 21, 22, 176 or 400");
  }
  return checks.result(out);
}

}  // namespace foretrack
