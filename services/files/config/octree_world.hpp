// SPDX-License-Identifier: Apache-2.0
// An OctoMap file as a world of boxes.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>

#include "core/simulator/world.hpp"

namespace foretrack {

/// Adds the occupied cells of an OctoMap file (.bt or .ot) to the world, merged into few boxes
/// (each a millimetre smaller on every side, so that cells which only touch do not count as
/// overlapping); what the octree does not know is free. With set_bounds the world's bounds become
/// those of the octree; without, only what is within the world's bounds is taken. Returns the
/// octree's resolution in metres. Throws std::invalid_argument that names the file and what is
/// wrong with it: bounds that do not meet it, with its extents, among that. Cost: linear in the
/// cells of the box.
double add_octree(const std::filesystem::path& file, bool set_bounds, World& world);

/// What is in an OctoMap file.
struct OctreeSummary {
  double resolution_m = 0.0;
  Vec3 min_m = Vec3::Zero(), max_m = Vec3::Zero();  ///< of all that it knows
  /// The least box around what is occupied; empty if nothing is.
  Eigen::AlignedBox3d occupied_m;
  std::size_t occupied_cells = 0, free_cells = 0;  ///< of the finest size
};

/// Throws as add_octree does.
OctreeSummary summarize_octree(const std::filesystem::path& file);

}  // namespace foretrack
