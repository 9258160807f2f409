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

TEST_F(OctreeWorld, AFileThatIsNoOctreeIsNamed) {
  std::ofstream(folder_ / "bad.bt") << "hello";
  World world;
  EXPECT_THAT([&] { add_octree(folder_ / "bad.bt", true, world); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("bad.bt")));
}

}  // namespace
}  // namespace foretrack
