// SPDX-License-Identifier: Apache-2.0
// What we tell ROS 2's tools, so that `ros2 node info` and its like show our nodes.
#pragma once

namespace foretrack {

class Node;

/// Which every node writes and reads.
inline constexpr char kRosGraphTopic[] = "ros_discovery_info";

/// Writes the node's endpoints to ros_discovery_info, in the layout of the distribution that the
/// node's options name: Humble and older have ids of 24 bytes, Iron and later of 16.
void announce_to_ros(Node& node);

}  // namespace foretrack
