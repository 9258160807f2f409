// SPDX-License-Identifier: Apache-2.0
// Cells of an octree by integer index: cell i covers [i, i + 1) · resolution on each axis.
#pragma once

#include <octomap/OcTree.h>

#include "core/common/geometry.hpp"

namespace foretrack {

inline constexpr int kTreeDepth = 16;                      ///< of every OctoMap octree
inline constexpr int kTreeCentre = 1 << (kTreeDepth - 1);  ///< the octree's key of index 0

/// The octree's key of a cell. Precondition: each index is in [-32768, 32768).
inline octomap::OcTreeKey key_of(const Eigen::Vector3i& index) {
  return {static_cast<octomap::key_type>(index.x() + kTreeCentre),
          static_cast<octomap::key_type>(index.y() + kTreeCentre),
          static_cast<octomap::key_type>(index.z() + kTreeCentre)};
}

/// Calls visit(occupied, from, to) for each known leaf that meets the box of cells [low, high). The
/// leaf's cells in the box are [from, to), counted from `low`: one cell, or many of a pruned leaf.
/// Cells that the octree does not know are not visited. Preconditions: the box is not empty and
/// inside the octree. Cost: linear in the leaves.
template <class Visit>
void for_each_leaf(const octomap::OcTree& tree, const Eigen::Vector3i& low,
                   const Eigen::Vector3i& high, Visit&& visit) {
  using Vec3i = Eigen::Vector3i;
  const auto end = tree.end_leafs_bbx();
  auto leaf = tree.begin_leafs_bbx(key_of(low), key_of(high - Vec3i::Ones()));
  for (; leaf != end; ++leaf) {
    const int edge = 1 << (kTreeDepth - leaf.getDepth());
    const auto key = leaf.getIndexKey();  // of its least corner
    const Vec3i corner = Vec3i(key[0], key[1], key[2]).array() - kTreeCentre;
    const Vec3i from = corner.cwiseMax(low) - low;
    const Vec3i to = (corner.array() + edge).matrix().cwiseMin(high) - low;
    visit(tree.isNodeOccupied(*leaf), from, to);
  }
}

}  // namespace foretrack
