// SPDX-License-Identifier: Apache-2.0
#include "services/convert/transforms.hpp"

#include <fmt/format.h>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kLongestName = 256;

void set_transform(const Pose& pose, double stamp_s, const std::string& parent,
                   const std::string& child, tf2_msgs::msg::TFMessage& out) {
  out.transforms().resize(1);
  auto& transform = out.transforms()[0];
  set_header(transform.header(), stamp_s, parent);
  transform.child_frame_id(child);
  set_xyz(transform.transform().translation(), pose.translation());
  set_orientation(transform.transform().rotation(), Quat(pose.rotation()));
}

std::string frame_of(const std::string& name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

std::optional<Fault> take(const geometry_msgs::msg::TransformStamped& row, bool is_static,
                          TransformTree& tree) {
  geometry_msgs::msg::Pose message;
  set_xyz(message.position(), xyz(row.transform().translation()));
  message.orientation(row.transform().rotation());
  Checks checks;
  checks.stamp("transforms.stamp", row.header().stamp());
  checks.count("transforms.frame_id", row.header().frame_id().size(), 1, kLongestName);
  checks.count("transforms.child_frame_id", row.child_frame_id().size(), 1, kLongestName);
  check_pose(checks, "transforms.translation", "transforms.rotation", message);
  if (!checks.ok()) return checks.result(0).fault();
  const auto parent = frame_of(row.header().frame_id()), child = frame_of(row.child_frame_id());
  const Pose pose = to_pose(message);
  const auto added = is_static
                         ? tree.add_static(parent, child, pose)
                         : tree.add_moving(parent, child, seconds(row.header().stamp()), pose);
  if (added == TransformTree::Added::kContradicts)
    return Fault{"another transform",
                 fmt::format("a second transform of '{}' (from '{}') contradicts the first one, "
                             "which stays: do two vehicles share the frame's name?",
                             child, parent)};
  if (added == TransformTree::Added::kFull) return Fault{"too many frames", "too many frames"};
  return std::nullopt;
}

}  // namespace

void to_transform(const VehicleState& state, const std::string& body_frame,
                  tf2_msgs::msg::TFMessage& out) {
  set_transform(state.T_world_body(), state.stamp_s, kWorldFrame, body_frame, out);
}

void to_transform(const Pose& T_body_camera, const std::string& body_frame,
                  const std::string& camera_frame, double stamp_s, tf2_msgs::msg::TFMessage& out) {
  set_transform(T_body_camera, stamp_s, body_frame, camera_frame, out);
}

std::optional<Fault> take_transforms(const tf2_msgs::msg::TFMessage& in, bool is_static,
                                     TransformTree& tree) {
  std::optional<Fault> first;
  for (const auto& row : in.transforms())
    if (auto fault = take(row, is_static, tree); fault && !first) first = std::move(fault);
  return first;
}

}  // namespace foretrack
