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

/// The same as rosbag2 has it in files: "foretrack_msgs/msg/TargetState", ros2msg.
const Schema* find_ros_schema(std::string_view wire_type);

/// How a type that was recorded stands to ours of its name.
enum class RecordedType {
  kSame,
  kOlder,    ///< ours has more fields at its end
  kOther,    ///< neither: it cannot be read as ours
  kUnknown,  ///< it is not in idl/
};
/// By its hash if there is one, else by the schema's text.
RecordedType compare_recorded(std::string_view wire_type, std::string_view hash,
                              std::string_view schema);

/// The name that people and tools use for a type on the wire, known or not.
std::string readable_type(std::string_view wire_type);

}  // namespace foretrack::station
