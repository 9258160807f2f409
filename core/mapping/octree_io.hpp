// SPDX-License-Identifier: Apache-2.0
// Octrees to and from bytes: octomap_msgs/Octomap and .bt files; octrees to dense grids.
#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <string>
#include <string_view>

#include "core/common/grid_map.hpp"

namespace foretrack {

/// `data` of octomap_msgs/Octomap with binary = true, id = "OcTree": two bits a node.
std::string octree_bytes(const octomap::OcTree& tree);

/// The octree of such bytes. Throws std::invalid_argument if they are not exactly one octree.
std::unique_ptr<octomap::OcTree> octree_from_bytes(std::string_view bytes, double resolution_m);

/// A .bt file. Throws std::invalid_argument that names the file and what is wrong with it.
std::unique_ptr<octomap::OcTree> read_octree(const std::string& path);
void write_octree(const octomap::OcTree& tree, const std::string& path);

/// The box [low, high) of an octree as a grid of the same resolution, with distances; the box is
/// widened to whole cells. What the octree does not know is unknown. Throws std::invalid_argument
/// if the box is empty, or has more than 1e8 cells.
GridMap grid_of_octree(const octomap::OcTree& tree, const Vec3& low_enu_m, const Vec3& high_enu_m);

/// All that the octree knows.
GridMap grid_of_octree(const octomap::OcTree& tree);

}  // namespace foretrack
