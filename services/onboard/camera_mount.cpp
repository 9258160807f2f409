// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/camera_mount.hpp"

#include <fmt/format.h>

#include "core/common/camera.hpp"

namespace foretrack {
namespace {

// Turned yaw, then pitch, then roll, as ROS has it.
Pose pose_of(const std::vector<double>& mount) {
  Pose pose = Pose::Identity();
  pose.translation() = Vec3(mount[0], mount[1], mount[2]);
  pose.linear() =
      (Eigen::AngleAxisd(mount[5], Vec3::UnitZ()) * Eigen::AngleAxisd(mount[4], Vec3::UnitY()) *
       Eigen::AngleAxisd(mount[3], Vec3::UnitX()))
          .toRotationMatrix();
  return pose * CameraModel::default_mount();
}

}  // namespace

CameraMount::CameraMount(Service& service, const std::vector<double>& configured,
                         TransformInput& transforms)
    : names_(service.options().names), transforms_(transforms) {
  if (configured.size() == 6) configured_ = pose_of(configured);
}

TransformTree::Found CameraMount::find(const std::string& frame_id, double stamp_s) const {
  const std::string plain = frame_id.starts_with('/') ? frame_id.substr(1) : frame_id;
  TransformTree::Found found;
  for (const auto& frame : {names_.frame(plain), plain})
    for (const auto& body : {names_.frame(names_.body_frame), names_.body_frame}) {
      found = transforms_.tree().find(body, frame, stamp_s);
      if (found.status != TransformTree::Status::kNoChain) return found;
    }
  return found;
}

std::optional<Pose> CameraMount::at(const std::string& frame_id, double stamp_s) {
  trouble_.clear();
  if (configured_) return *configured_;
  transforms_.update();
  const auto found = find(frame_id, stamp_s);
  if (found.status == TransformTree::Status::kFound) return found.T_to_from;
  trouble_ = found.why;
  if (found.status == TransformTree::Status::kNotThen) return std::nullopt;
  trouble_ = fmt::format("where the camera '{}' sits is not known ({}); it is taken to look ahead",
                         frame_id.substr(0, 64), found.why);
  return CameraModel::default_mount();
}

}  // namespace foretrack
