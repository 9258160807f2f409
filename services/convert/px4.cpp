// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4.hpp"

#include <limits>
#include <string>

#include "core/common/frames.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/px4_time.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;
namespace odometry = msg::VehicleOdometry_Constants;
namespace vehicle = msg::VehicleStatus_Constants;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kAutopilotComponent = 1;
constexpr double kMaxStamp_s = 1e10;

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

FlightMode mode_of(std::uint8_t nav_state) {
  switch (nav_state) {
    case vehicle::NAVIGATION_STATE_OFFBOARD:
      return FlightMode::kOffboard;
    case vehicle::NAVIGATION_STATE_MANUAL:
    case vehicle::NAVIGATION_STATE_ALTCTL:
    case vehicle::NAVIGATION_STATE_POSCTL:
    case vehicle::NAVIGATION_STATE_POSITION_SLOW:
    case vehicle::NAVIGATION_STATE_ALTITUDE_CRUISE:
    case vehicle::NAVIGATION_STATE_ACRO:
    case vehicle::NAVIGATION_STATE_STAB:
      return FlightMode::kPilot;
    case vehicle::NAVIGATION_STATE_AUTO_LOITER:
      return FlightMode::kHold;
    case vehicle::NAVIGATION_STATE_AUTO_TAKEOFF:
      return FlightMode::kTakeOff;
    case vehicle::NAVIGATION_STATE_AUTO_RTL:
      return FlightMode::kReturn;
    case vehicle::NAVIGATION_STATE_AUTO_LAND:
    case vehicle::NAVIGATION_STATE_DESCEND:
      return FlightMode::kLand;
    case vehicle::NAVIGATION_STATE_TERMINATION:
      return FlightMode::kTermination;
    default:
      return FlightMode::kOther;
  }
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
  out.nav_state_user_intention(nav_state_of(in));
  out.failsafe(in.failsafe);
  out.failsafe_and_user_took_over(in.user_took_over);
  out.system_id(static_cast<std::uint8_t>(in.system_id));
  out.component_id(kAutopilotComponent);
  out.pre_flight_checks_pass(true);
}

Converted<AutopilotStatus> from_idl(const msg::VehicleStatus& in) {
  Checks checks;
  AutopilotStatus out;
  out.stamp_s = read_stamp(checks, in.timestamp());
  checks.enumerator("arming_state", in.arming_state(), vehicle::ARMING_STATE_ARMED);
  out.armed = in.arming_state() == vehicle::ARMING_STATE_ARMED;
  out.mode = mode_of(in.nav_state());
  out.offboard = out.mode == FlightMode::kOffboard;
  out.failsafe = in.failsafe();
  out.user_took_over = in.failsafe_and_user_took_over();
  out.system_id = in.system_id();
  return checks.result(out);
}

bool sticks_moved(const msg::ManualControlSetpoint& in) {
  return in.valid() && in.sticks_moving();
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

}  // namespace foretrack
