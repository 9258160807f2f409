// SPDX-License-Identifier: Apache-2.0
#include "services/convert/vehicle.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

void set_transform(const Pose& pose, double stamp_s, const char* parent, const char* child,
                   tf2_msgs::msg::TFMessage& out) {
  out.transforms().resize(1);
  auto& transform = out.transforms()[0];
  set_header(transform.header(), stamp_s, parent);
  transform.child_frame_id(child);
  set_xyz(transform.transform().translation(), pose.translation());
  set_orientation(transform.transform().rotation(), Quat(pose.rotation()));
}

}  // namespace

void to_idl(const VehicleState& in, nav_msgs::msg::Odometry& out) {
  set_header(out.header(), in.stamp_s);
  out.child_frame_id(kBodyFrame);
  set_xyz(out.pose().pose().position(), in.position_enu_m);
  set_orientation(out.pose().pose().orientation(), in.q_world_body);
  set_xyz(out.twist().twist().linear(), in.q_world_body.conjugate() * in.velocity_enu_m_s);
  set_xyz(out.twist().twist().angular(), in.angular_velocity_body_rad_s);
}

Converted<VehicleState> from_idl(const nav_msgs::msg::Odometry& in) {
  Checks checks;
  VehicleState out;
  check_header(checks, in.header());
  if (!in.child_frame_id().ends_with(kBodyFrame))
    checks.frame("child_frame_id", in.child_frame_id(), kBodyFrame);
  const auto& twist = in.twist().twist();
  check_pose(checks, "pose.position", "pose.orientation", in.pose().pose());
  check_xyz(checks, "twist.linear", twist.linear(), limits::kSpeed_m_s);
  check_xyz(checks, "twist.angular", twist.angular(), limits::kRate_rad_s);
  out.stamp_s = seconds(in.header().stamp());
  out.position_enu_m = xyz(in.pose().pose().position());
  out.q_world_body = orientation(in.pose().pose().orientation());
  out.velocity_enu_m_s = out.q_world_body * xyz(twist.linear());
  out.angular_velocity_body_rad_s = xyz(twist.angular());
  return checks.result(out);
}

void to_transform(const VehicleState& state, tf2_msgs::msg::TFMessage& out) {
  set_transform(state.T_world_body(), state.stamp_s, kWorldFrame, kBodyFrame, out);
}

std::optional<Pose> mount_of(const tf2_msgs::msg::TFMessage& in, std::string_view frame) {
  for (const auto& row : in.transforms()) {
    if (row.child_frame_id() != frame || !row.header().frame_id().ends_with(kBodyFrame)) continue;
    geometry_msgs::msg::Pose pose;
    set_xyz(pose.position(), xyz(row.transform().translation()));
    pose.orientation(row.transform().rotation());
    Checks checks;
    check_pose(checks, "translation", "rotation", pose);
    if (checks.ok()) return to_pose(pose);
  }
  return std::nullopt;
}

void to_transform(const Pose& T_body_camera, double stamp_s, tf2_msgs::msg::TFMessage& out) {
  set_transform(T_body_camera, stamp_s, kBodyFrame, kCameraFrame, out);
}

}  // namespace foretrack
