// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/octree_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/mapping/octree_io.hpp"
#include "services/files/config/load_scenario.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

class OctreeWorld : public testing::Test {
 protected:
  OctreeWorld() : folder_(fs::temp_directory_path() / "foretrack_octree_world") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~OctreeWorld() override { fs::remove_all(folder_); }

  // An L of two walls, 2 m high, on a field 8 m square whose air is known up to 3 m; and one cell.
  std::string write_tree() {
    octomap::OcTree tree(0.2);
    for (double x = -3.9; x < 4.0; x += 0.2)
      for (double y = -3.9; y < 4.0; y += 0.2)
        for (double z = 0.1; z < 3.0; z += 0.2) tree.updateNode(x, y, z, is_wall(x, y, z));
    tree.updateInnerOccupancy();
    const fs::path file = folder_ / "yard.bt";
    write_octree(tree, file.string());
    return file.string();
  }
  static bool is_wall(double x, double y, double z) {
    if (z > 2.0) return false;
    const bool along_x = y > 1.0 && y < 1.4 && x > -2.0 && x < 2.0;
    const bool along_y = x > 1.6 && x < 2.0 && y > -2.0 && y < 1.4;
    return along_x || along_y || (x > -3.0 && x < -2.8 && y > -3.0 && y < -2.8);
  }
  fs::path folder_;
};

TEST_F(OctreeWorld, FewBoxesCoverExactlyTheOccupiedCells) {
  World world;
  EXPECT_DOUBLE_EQ(add_octree(write_tree(), true, world), 0.2);
  EXPECT_LE(world.boxes.size(), 4u);
  EXPECT_NEAR((world.min_m - Vec3(-4, -4, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((world.max_m - Vec3(4, 4, 3)).norm(), 0.0, 1e-9);
  for (double x = -3.9; x < 4.0; x += 0.2)
    for (double y = -3.9; y < 4.0; y += 0.2)
      for (const double z : {0.1, 1.9, 2.1})
        EXPECT_EQ(clearance_m(world, {x, y, z}) < 0.0, is_wall(x, y, z)) << x << " " << y;
}

TEST_F(OctreeWorld, TheKnownMapOfItHasTheSameCells) {
  World world;
  add_octree(write_tree(), true, world);
  const GridMap map = known_map(world, 0.2);
  for (double x = -3.9; x < 4.0; x += 0.2)
    for (double y = -3.9; y < 4.0; y += 0.2)
      EXPECT_EQ(map.is_occupied({x, y, 0.5}), is_wall(x, y, 0.5)) << x << " " << y;
}

TEST_F(OctreeWorld, AScenarioFliesInItAlongATrack) {
  write_tree();
  std::ofstream(folder_ / "walk.xy") << "0 1 -3.5 0\n25 1 -2.5 0\n50 1 -1.5 0\n75 1 -0.5 0\n";
  std::ofstream(folder_ / "case.yaml")
      << "world: {octree: yard.bt}\ntarget: {track: {file: walk.xy, format: xy}}\n";
  const Scenario s = load_scenario((folder_ / "case.yaml").string());
  EXPECT_DOUBLE_EQ(s.map_resolution_m, 0.2);
  EXPECT_FALSE(s.world.boxes.empty());
  EXPECT_LE(s.world.min_m.x(), -11.0);  // room around the track
  EXPECT_GE(s.world.max_m.y(), 8.0);
}

TEST_F(OctreeWorld, OnlyWhatIsWithinTheBoundsIsTaken) {
  World world;
  world.min_m = {0, -2, 0};
  world.max_m = {3, 2, 1};
  add_octree(write_tree(), false, world);
  EXPECT_EQ(world.max_m, Vec3(3, 2, 1));
  ASSERT_FALSE(world.boxes.empty());
  for (const Box& box : world.boxes) {
    EXPECT_GE(box.min_m.x(), 0.0);
    EXPECT_LE(box.max_m.z(), 1.0 + 1e-6);
  }
  EXPECT_LT(clearance_m(world, {1.7, 0, 0.5}), 0.0);
  world.min_m = {30, 30, 0};
  world.max_m = {40, 40, 1};
  EXPECT_THAT([&] { add_octree(write_tree(), false, world); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(
                  "it reaches from (-4.00, -4.00, 0.00) to (4.00, 4.00, 3.00)")));
}

TEST_F(OctreeWorld, FullTreesAreReadToo) {
  const auto tree = read_octree(write_tree());
  const fs::path full = folder_ / "yard.ot";
  ASSERT_TRUE(tree->write(full.string()));
  World world, of_full;
  add_octree(write_tree(), true, world);
  add_octree(full, true, of_full);
  EXPECT_EQ(of_full.boxes.size(), world.boxes.size());
  EXPECT_EQ(of_full.max_m, world.max_m);
}

TEST_F(OctreeWorld, ASummaryHasExtentsAndCells) {
  const auto summary = summarize_octree(write_tree());
  EXPECT_DOUBLE_EQ(summary.resolution_m, 0.2);
  EXPECT_NEAR((summary.max_m - Vec3(4, 4, 3)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((summary.occupied_m.min() - Vec3(-3, -3, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((summary.occupied_m.max() - Vec3(2, 1.4, 2)).norm(), 0.0, 1e-9);
  EXPECT_EQ(summary.occupied_cells + summary.free_cells, 40u * 40u * 15u);
}

TEST_F(OctreeWorld, AFileThatIsNoOctreeIsNamed) {
  std::ofstream(folder_ / "bad.bt") << "hello";
  World world;
  EXPECT_THAT([&] { add_octree(folder_ / "bad.bt", true, world); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("bad.bt")));
}

}  // namespace
}  // namespace foretrack
