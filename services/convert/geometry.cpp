// SPDX-License-Identifier: Apache-2.0
#include "services/convert/geometry.hpp"

namespace foretrack {

void set_orientation(geometry_msgs::msg::Quaternion& out, const Quat& q) {
  out.w(q.w());
  out.x(q.x());
  out.y(q.y());
  out.z(q.z());
}

Quat orientation(const geometry_msgs::msg::Quaternion& in) {
  return Quat(in.w(), in.x(), in.y(), in.z()).normalized();
}

void set_pose(geometry_msgs::msg::Pose& out, const Pose& pose) {
  set_xyz(out.position(), pose.translation());
  set_orientation(out.orientation(), Quat(pose.rotation()));
}

void check_pose(Checks& checks, std::string_view position_field, std::string_view rotation_field,
                const geometry_msgs::msg::Pose& in) {
  check_xyz(checks, position_field, in.position(), limits::kPosition_m);
  const auto& q = in.orientation();
  checks.unit(rotation_field, Quat(q.w(), q.x(), q.y(), q.z()).norm());
}

Pose to_pose(const geometry_msgs::msg::Pose& in) {
  Pose pose = Pose::Identity();
  pose.linear() = orientation(in.orientation()).toRotationMatrix();
  pose.translation() = xyz(in.position());
  return pose;
}

}  // namespace foretrack
