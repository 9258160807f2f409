// SPDX-License-Identifier: Apache-2.0
// What a sample of each type that we know looks like, for programs that decode it.
#pragma once

#include <string>
#include <string_view>

namespace foretrack::station {

struct Schema {
  std::string_view name;      // "nav_msgs/msg/Odometry", "foretrack_msgs::msg::TargetState"
  std::string_view encoding;  // "ros2msg", "omgidl"
  std::string_view text;      // with the definitions of all types inside
};

/// Of a type as named on the wire: nav_msgs::msg::dds_::Odometry_. ROS 2's and PX4's types are
/// ros2msg, ours are omgidl. Null if the type is not in idl/. Cost: a binary search.
const Schema* find_schema(std::string_view wire_type);

/// The name that people and tools use for a type on the wire, known or not.
std::string readable_type(std::string_view wire_type);

}  // namespace foretrack::station
