// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/octree_cells.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;
constexpr double kResolution_m = 0.2;

Vec3i random_cell(Random& random, int reach) {
  return {random.integer(-reach, reach), random.integer(-reach, reach),
          random.integer(-reach, reach)};
}

// Scattered cells, and a large pruned cube of free ones.
octomap::OcTree make_tree() {
  octomap::OcTree tree(kResolution_m);
  Random random(4);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z)
        tree.setNodeValue(key_of({x, y, z}), tree.getClampingThresMinLog());
  for (int i = 0; i < 300; ++i)
    tree.setNodeValue(key_of(random_cell(random, 12)), random.chance(0.5)
                                                           ? tree.getClampingThresMaxLog()
                                                           : tree.getClampingThresMinLog());
  tree.prune();
  return tree;
}

TEST(OctreeCells, KeyOfAnIndexIsThatOfThePointsInItsCell) {
  const octomap::OcTree tree(kResolution_m);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3i cell = random_cell(random, 1000);
    const Vec3 point =
        kResolution_m * (cell.cast<double>() + Vec3(random.uniform(0.01, 0.99), 0.5, 0.01));
    EXPECT_EQ(key_of(cell), tree.coordToKey(octomap::point3d(static_cast<float>(point.x()),
                                                             static_cast<float>(point.y()),
                                                             static_cast<float>(point.z()))));
  }
}

// Each cell of each box is visited once if the tree knows it, with what the tree says of it.
TEST(OctreeCells, LeavesCoverExactlyTheKnownCellsOfTheBox) {
  const octomap::OcTree tree = make_tree();
  Random random(2);
  for (int box = 0; box < 40; ++box) {
    const Vec3i low = random_cell(random, 10);
    const Vec3i size(random.integer(1, 9), random.integer(1, 9), random.integer(1, 9));
    std::vector<int> seen(static_cast<std::size_t>(size.prod()), -1);
    const auto place = [&](int x, int y, int z) -> int& {
      return seen[static_cast<std::size_t>((z * size.y() + y) * size.x() + x)];
    };
    for_each_leaf(tree, low, low + size, [&](bool occupied, const Vec3i& from, const Vec3i& to) {
      ASSERT_TRUE((from.array() >= 0).all() && (to.array() <= size.array()).all());
      for (int z = from.z(); z < to.z(); ++z)
        for (int y = from.y(); y < to.y(); ++y)
          for (int x = from.x(); x < to.x(); ++x) {
            EXPECT_EQ(place(x, y, z), -1) << "visited twice";
            place(x, y, z) = occupied;
          }
    });
    for (int z = 0; z < size.z(); ++z)
      for (int y = 0; y < size.y(); ++y)
        for (int x = 0; x < size.x(); ++x) {
          const auto* node = tree.search(key_of(low + Vec3i(x, y, z)));
          ASSERT_EQ(place(x, y, z), node ? int{tree.isNodeOccupied(node)} : -1);
        }
  }
}

}  // namespace
}  // namespace foretrack
