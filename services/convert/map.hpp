// SPDX-License-Identifier: Apache-2.0
// Maps: the box of voxels around the vehicle, and the whole octree for others.
#pragma once

#include <octomap/OcTree.h>

#include "core/common/grid_map.hpp"
#include "foretrack_msgs/msg/LocalMap.h"
#include "octomap_msgs/msg/Octomap.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Reuses the memory of `out`. Throws std::length_error beyond the bound of the IDL.
void to_idl(const GridMap& map, foretrack_msgs::msg::LocalMap& out);
/// Moves the cells out of its argument: move a message in, and nothing is copied. An empty map is a
/// fault.
Converted<GridMap> from_idl(foretrack_msgs::msg::LocalMap in);

/// The centres of the occupied cells.
void to_points(const GridMap& map, sensor_msgs::msg::PointCloud2& out);

/// The binary form (occupied, free) that octomap_msgs' binaryMsgToMap reads.
void to_idl(const octomap::OcTree& tree, double stamp_s, octomap_msgs::msg::Octomap& out);

}  // namespace foretrack
