// SPDX-License-Identifier: Apache-2.0
#include "services/convert/vehicle.hpp"

#include <fmt/format.h>

namespace foretrack {
namespace {

bool is_or_ends_with(std::string_view frame, const std::string& name) {
  return frame == name || frame.ends_with('/' + name);
}

// T_map_frame of the frame that the odometry is in, or a fault.
Pose map_pose(Checks& checks, const nav_msgs::msg::Odometry& in, const OdometryFrames& frames) {
  const std::string& frame = in.header().frame_id();
  std::string why;
  if (frames.is_map || frame == kWorldFrame) return Pose::Identity();
  if (frames.in_map)
    if (const auto pose = frames.in_map(frame, seconds(in.header().stamp()), why)) return *pose;
  checks.fail("header.frame_id", fmt::format("'{}'", frame.substr(0, 64)),
              fmt::format("'map', a transform map -> {}{}, or --odometry-is-map",
                          frame.empty() ? "odom" : frame.substr(0, 64),
                          why.empty() ? "" : " (" + why + ")"));
  return Pose::Identity();
}

}  // namespace

void to_idl(const VehicleState& in, nav_msgs::msg::Odometry& out, std::string_view body_frame) {
  set_header(out.header(), in.stamp_s);
  out.child_frame_id(std::string(body_frame));
  set_xyz(out.pose().pose().position(), in.position_enu_m);
  set_orientation(out.pose().pose().orientation(), in.q_world_body);
  set_xyz(out.twist().twist().linear(), in.q_world_body.conjugate() * in.velocity_enu_m_s);
  set_xyz(out.twist().twist().angular(), in.angular_velocity_body_rad_s);
}

Converted<VehicleState> from_idl(const nav_msgs::msg::Odometry& in, const OdometryFrames& frames) {
  Checks checks;
  VehicleState out;
  checks.stamp("header.stamp", in.header().stamp());
  if (!is_or_ends_with(in.child_frame_id(), frames.body))
    checks.frame("child_frame_id", in.child_frame_id(), frames.body);
  const auto& twist = in.twist().twist();
  check_pose(checks, "pose.position", "pose.orientation", in.pose().pose());
  check_xyz(checks, "twist.linear", twist.linear(), limits::kSpeed_m_s);
  check_xyz(checks, "twist.angular", twist.angular(), limits::kRate_rad_s);
  const Pose T_map_frame = checks.ok() ? map_pose(checks, in, frames) : Pose::Identity();
  if (!checks.ok()) return checks.result(out);
  out.stamp_s = seconds(in.header().stamp());
  out.position_enu_m = T_map_frame * xyz(in.pose().pose().position());
  out.q_world_body =
      (Quat(T_map_frame.rotation()) * orientation(in.pose().pose().orientation())).normalized();
  out.velocity_enu_m_s = out.q_world_body * xyz(twist.linear());
  out.angular_velocity_body_rad_s = xyz(twist.angular());
  return checks.result(out);
}

}  // namespace foretrack
