// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/octree_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "core/mapping/octree_io.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

constexpr double kSkin_m = 1e-3;

// Occupied cells of a grid, taken away box by box: along x, then y, then z as far as all are there.
class Merging {
 public:
  explicit Merging(GridMap& grid) : grid_(grid) {}

  void run(std::vector<Box>& boxes) {
    Vec3i i;
    for (i.z() = 0; i.z() < grid_.size.z(); ++i.z())
      for (i.y() = 0; i.y() < grid_.size.y(); ++i.y())
        for (i.x() = 0; i.x() < grid_.size.x(); ++i.x())
          if (is_occupied(i)) boxes.push_back(take(i));
  }

 private:
  bool is_occupied(const Vec3i& i) const {
    return grid_.cells[grid_.offset_of(i)] == static_cast<std::uint8_t>(Cell::kOccupied);
  }
  template <class Visit>
  static bool all_of(const Vec3i& from, const Vec3i& to, Visit&& visit) {
    Vec3i i;
    for (i.z() = from.z(); i.z() < to.z(); ++i.z())
      for (i.y() = from.y(); i.y() < to.y(); ++i.y())
        for (i.x() = from.x(); i.x() < to.x(); ++i.x())
          if (!visit(i)) return false;
    return true;
  }

  Box take(const Vec3i& from) {
    Vec3i to = from + Vec3i::Ones();
    for (int axis = 0; axis < 3; ++axis)
      while (to[axis] < grid_.size[axis]) {
        Vec3i low = from, high = to;
        low[axis] = to[axis];
        high[axis] = to[axis] + 1;
        if (!all_of(low, high, [&](const Vec3i& i) { return is_occupied(i); })) break;
        ++to[axis];
      }
    all_of(from, to, [&](const Vec3i& i) {
      grid_.cells[grid_.offset_of(i)] = static_cast<std::uint8_t>(Cell::kFree);
      return true;
    });
    const Vec3 skin = Vec3::Constant(kSkin_m);
    return {grid_.origin_enu_m + grid_.resolution_m * from.cast<double>() + skin,
            grid_.origin_enu_m + grid_.resolution_m * to.cast<double>() - skin};
  }

  GridMap& grid_;
};

std::unique_ptr<octomap::OcTree> read(const std::filesystem::path& file) {
  auto tree = read_octree(file.string());
  if (tree->size() == 0) throw std::invalid_argument(file.string() + ": the octree is empty");
  return tree;
}

Eigen::AlignedBox3d extents_of(const octomap::OcTree& tree) {
  Eigen::AlignedBox3d box(Vec3::Zero(), Vec3::Zero());
  tree.getMetricMin(box.min().x(), box.min().y(), box.min().z());
  tree.getMetricMax(box.max().x(), box.max().y(), box.max().z());
  return box;
}

GridMap within(const octomap::OcTree& tree, const std::filesystem::path& file, const World& world) {
  const auto extents = extents_of(tree);
  const auto box = extents.intersection({world.min_m, world.max_m});
  if (((box.max() - box.min()).array() < tree.getResolution()).any())
    throw std::invalid_argument(
        fmt::format("{}: nothing of it is within bounds_m; it reaches from ({:.2f}) to ({:.2f}) m",
                    file.string(), fmt::join(extents.min(), ", "), fmt::join(extents.max(), ", ")));
  return grid_of_octree(tree, box.min(), box.max());
}

}  // namespace

double add_octree(const std::filesystem::path& file, bool set_bounds, World& world) {
  const auto tree = read(file);
  GridMap grid = set_bounds ? grid_of_octree(*tree) : within(*tree, file, world);
  if (set_bounds) {
    world.min_m = grid.origin_enu_m;
    world.max_m = grid.origin_enu_m + grid.resolution_m * grid.size.cast<double>();
  }
  Merging(grid).run(world.boxes);
  return grid.resolution_m;
}

OctreeSummary summarize_octree(const std::filesystem::path& file) {
  const auto tree = read(file);
  OctreeSummary summary;
  summary.resolution_m = tree->getResolution();
  summary.min_m = extents_of(*tree).min();
  summary.max_m = extents_of(*tree).max();
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    const std::size_t side = std::size_t{1} << (tree->getTreeDepth() - leaf.getDepth());
    const bool occupied = tree->isNodeOccupied(*leaf);
    (occupied ? summary.occupied_cells : summary.free_cells) += side * side * side;
    if (!occupied) continue;
    const Vec3 centre(leaf.getX(), leaf.getY(), leaf.getZ());
    const Vec3 half = Vec3::Constant(0.5 * leaf.getSize());
    summary.occupied_m.extend(centre - half).extend(centre + half);
  }
  return summary;
}

}  // namespace foretrack
