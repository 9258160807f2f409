// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/octree_world.hpp"

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

}  // namespace

double add_octree(const std::filesystem::path& file, bool set_bounds, World& world) {
  const auto tree = read_octree(file.string());
  if (tree->size() == 0) throw std::invalid_argument(file.string() + ": the octree is empty");
  GridMap grid = grid_of_octree(*tree);
  if (set_bounds) {
    world.min_m = grid.origin_enu_m;
    world.max_m = grid.origin_enu_m + grid.resolution_m * grid.size.cast<double>();
  }
  Merging(grid).run(world.boxes);
  return grid.resolution_m;
}

}  // namespace foretrack
