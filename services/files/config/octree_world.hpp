// SPDX-License-Identifier: Apache-2.0
// An OctoMap file as a world of boxes.
#pragma once

#include <filesystem>

#include "core/simulator/world.hpp"

namespace foretrack {

/// Adds the occupied cells of a .bt file to the world, merged into few boxes (each a millimetre
/// smaller on every side, so that cells which only touch do not count as overlapping); what the
/// octree does not know is free. With set_bounds the world's bounds become those of the octree.
/// Returns the octree's resolution in metres. Throws std::invalid_argument that names the file and
/// what is wrong with it. Cost: linear in the cells of the octree's bounding box.
double add_octree(const std::filesystem::path& file, bool set_bounds, World& world);

}  // namespace foretrack
