// SPDX-License-Identifier: Apache-2.0
// Transforms as tf has them.
#pragma once

#include <optional>
#include <string>

#include "core/common/transform_tree.hpp"
#include "core/common/vehicle.hpp"
#include "services/convert/checks.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

/// map → the body's frame.
void to_transform(const VehicleState& state, const std::string& body_frame,
                  tf2_msgs::msg::TFMessage& out);
/// The body's frame → a camera's.
void to_transform(const Pose& T_body_camera, const std::string& body_frame,
                  const std::string& camera_frame, double stamp_s, tf2_msgs::msg::TFMessage& out);

/// Puts what can be taken into the tree; the rest is the fault (the first one): malformed, or in
/// contradiction to what the tree has. Leading slashes of frames are dropped.
std::optional<Fault> take_transforms(const tf2_msgs::msg::TFMessage& in, bool is_static,
                                     TransformTree& tree);

}  // namespace foretrack
