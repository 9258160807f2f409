// SPDX-License-Identifier: Apache-2.0
// The vehicle's state as ROS 2 speaks it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/common/vehicle.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "services/convert/checks.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {

/// Pose in "map", twist in the body (FLU), as nav_msgs has it. Covariances are zero: not known.
void to_idl(const VehicleState& state, nav_msgs::msg::Odometry& out,
            std::string_view body_frame = kBodyFrame);

/// How odometry of others is read.
struct OdometryFrames {
  std::string body = kBodyFrame;  ///< its child frame, which may have a prefix: "uav1/base_link"
  bool is_map = false;            ///< whatever frame it names is taken for the map
  /// T_map_frame at a time; none: not known, and `why` says why. Without it only "map" is read.
  std::function<std::optional<Pose>(const std::string& frame, double stamp_s, std::string& why)>
      in_map = {};
};

/// The state in the map. Covariances are not read.
Converted<VehicleState> from_idl(const nav_msgs::msg::Odometry& in,
                                 const OdometryFrames& frames = {});

}  // namespace foretrack
