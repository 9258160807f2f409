// SPDX-License-Identifier: Apache-2.0
// The vehicle's state as ROS 2 speaks it.
#pragma once

#include <optional>
#include <string_view>

#include "core/common/vehicle.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "services/convert/checks.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

/// Pose in "map", twist in "base_link" (the body, FLU), as nav_msgs has it. Covariances are zero:
/// not known.
void to_idl(const VehicleState& state, nav_msgs::msg::Odometry& out);
/// The child frame may have a prefix ("uav1/base_link"). Covariances are not read.
Converted<VehicleState> from_idl(const nav_msgs::msg::Odometry& in);

/// map → base_link.
void to_transform(const VehicleState& state, tf2_msgs::msg::TFMessage& out);
/// base_link → camera_optical_frame.
void to_transform(const Pose& T_body_camera, double stamp_s, tf2_msgs::msg::TFMessage& out);

/// The pose in base_link of that frame, if the message has it.
std::optional<Pose> mount_of(const tf2_msgs::msg::TFMessage& in, std::string_view frame);

}  // namespace foretrack
