// SPDX-License-Identifier: Apache-2.0
// Octrees to and from bytes: octomap_msgs/Octomap and .bt files; octrees to dense grids.
#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <string>
#include <string_view>

#include "core/common/grid_map.hpp"

namespace foretrack {

/// The octree as the bytes that octomap_msgs/Octomap carries in `data` (binary = true, id =
/// "OcTree"): occupied, free or not known, two bits for each child of a node.
std::string octree_bytes(const octomap::OcTree& tree);

/// The octree of such bytes; no bytes are an empty octree. Throws std::invalid_argument if they are
/// not exactly one octree, or the resolution is not above 0.
std::unique_ptr<octomap::OcTree> octree_from_bytes(std::string_view bytes, double resolution_m);

/// Reads a .bt or an .ot file, as OctoMap's own tools write them. Throws std::invalid_argument that
/// names the file and what is wrong with it.
std::unique_ptr<octomap::OcTree> read_octree(const std::string& path);
/// Writes a .bt file. Throws std::invalid_argument that names the file if it cannot be written.
void write_octree(const octomap::OcTree& tree, const std::string& path);

/// The box [low, high) of an octree as a grid of the same resolution, with distances. The box is
/// widened to whole cells. Cells that the octree does not know are unknown. Throws
/// std::invalid_argument if the box is empty, not finite, outside the octree, or has more than 1e8
/// cells. Cost: about 10 ns for each cell.
GridMap grid_of_octree(const octomap::OcTree& tree, const Vec3& low_enu_m, const Vec3& high_enu_m);

/// The same of the least box that holds all that the octree knows.
GridMap grid_of_octree(const octomap::OcTree& tree);

}  // namespace foretrack
