// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/octree_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/common/random.hpp"
#include "core/mapping/octree_cells.hpp"
#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using ::testing::HasSubstr;
using Vec3i = Eigen::Vector3i;

octomap::OcTree random_tree(std::uint64_t seed) {
  octomap::OcTree tree(0.2);
  Random random(seed);
  for (int k = 0; k < 800; ++k) {
    const Vec3i i(random.integer(-8, 8), random.integer(-8, 8), random.integer(-2, 9));
    tree.updateNode(key_of(i), random.chance(0.3));
  }
  for (int z = 0; z < 8; ++z)  // a cube that prunes
    for (int y = 0; y < 8; ++y)
      for (int x = 16; x < 24; ++x) tree.setNodeValue(key_of({x, y, z}), -2.0f);
  return tree;
}

Cell cell_of(const octomap::OcTree& tree, const Vec3& p) {
  const auto* node = tree.search(p.x(), p.y(), p.z());
  if (node == nullptr) return Cell::kUnknown;
  return tree.isNodeOccupied(*node) ? Cell::kOccupied : Cell::kFree;
}

// A file that is gone after the test.
struct TemporaryFile {
  std::string path = (std::filesystem::temp_directory_path() /
                      ("foretrack_octree_" + std::to_string(::getpid()) + ".bt"))
                         .string();
  ~TemporaryFile() { std::remove(path.c_str()); }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
};

std::string error_of(const std::string& path) {
  return foretrack::error_of([&] { read_octree(path); });
}

TEST(OctreeIo, GridHasTheCellsOfTheOctree) {
  const octomap::OcTree tree = random_tree(1);
  const GridMap map = grid_of_octree(tree);
  int known = 0;
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const Vec3 p = map.center_of({x, y, z});
        ASSERT_EQ(map.cell_at(p), cell_of(tree, p)) << p.transpose();
        known += map.cell_at(p) != Cell::kUnknown;
      }
  EXPECT_GT(known, 1000);
  EXPECT_EQ(map.occupied_distance_cm.size(), map.cell_count());
}

TEST(OctreeIo, BoundsAreWidenedToWholeCells) {
  const GridMap map = grid_of_octree(random_tree(2), {-0.5, -0.2, 0.0}, {0.6, 0.21, 1.0});
  EXPECT_LT((map.origin_enu_m - Vec3(-0.6, -0.2, 0.0)).norm(), 1e-12);
  EXPECT_EQ(map.size, Vec3i(6, 3, 5));
}

TEST(OctreeIo, BadBoundsAreRefused) {
  const octomap::OcTree tree = random_tree(2);
  EXPECT_THROW(grid_of_octree(tree, Vec3(1, 0, 0), Vec3(0, 1, 1)), std::invalid_argument);
  EXPECT_THROW(grid_of_octree(tree, Vec3::Zero(), Vec3::Constant(1e4)), std::invalid_argument);
  EXPECT_THROW(grid_of_octree(tree, Vec3::Zero(), Vec3::Constant(std::nan(""))),
               std::invalid_argument);
  EXPECT_THROW(grid_of_octree(octomap::OcTree(0.1)), std::invalid_argument);
}

TEST(OctreeIo, BytesAndFilesRoundTrip) {
  const octomap::OcTree tree = random_tree(3);
  const GridMap expected = grid_of_octree(tree);
  const auto from_bytes = octree_from_bytes(octree_bytes(tree), 0.2);
  EXPECT_EQ(grid_of_octree(*from_bytes).cells, expected.cells);
  TemporaryFile file;
  write_octree(tree, file.path);
  const auto from_file = read_octree(file.path);
  EXPECT_EQ(from_file->getResolution(), 0.2);
  EXPECT_EQ(grid_of_octree(*from_file).cells, expected.cells);
  EXPECT_EQ(octree_from_bytes("", 0.2)->size(), 0u);
}

TEST(OctreeIo, ReadsWhatOctoMapItselfWrites) {
  octomap::OcTree tree = random_tree(4);
  TemporaryFile file;
  ASSERT_TRUE(tree.writeBinary(file.path));
  EXPECT_EQ(grid_of_octree(*read_octree(file.path)).cells, grid_of_octree(tree).cells);
  TemporaryFile ours;
  write_octree(tree, ours.path);
  octomap::OcTree again(0.5);
  ASSERT_TRUE(again.readBinary(ours.path));
  EXPECT_EQ(grid_of_octree(again).cells, grid_of_octree(tree).cells);
}

TEST(OctreeIo, BrokenBytesAreRefusedAtEveryLength) {
  const std::string bytes = octree_bytes(random_tree(5));
  for (std::size_t length = 1; length < bytes.size(); ++length)
    ASSERT_THROW(octree_from_bytes(bytes.substr(0, length), 0.2), std::invalid_argument) << length;
  EXPECT_THROW(octree_from_bytes(bytes + "x", 0.2), std::invalid_argument);
  EXPECT_THROW(octree_from_bytes(std::string(4000, '\xff'), 0.2), std::invalid_argument);
  EXPECT_THROW(octree_from_bytes(bytes, 0.0), std::invalid_argument);
}

TEST(OctreeIo, FullTreesAreReadAndBrokenOnesRefusedAtEveryLength) {
  const octomap::OcTree tree = random_tree(7);
  const TemporaryFile file;
  std::ostringstream nodes;
  tree.writeData(nodes);
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file.path, std::ios::binary)
        << "# Octomap OcTree file\nid OcTree\nsize " << tree.size() << "\nres "
        << tree.getResolution() << "\ndata\n"
        << bytes;
  };
  const std::string whole = nodes.str();
  write(whole);
  EXPECT_EQ(read_octree(file.path)->size(), tree.size());
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 97) {
    write(whole.substr(0, size));
    EXPECT_THROW(read_octree(file.path), std::invalid_argument) << size;
  }
  write(whole + "x");
  EXPECT_THROW(read_octree(file.path), std::invalid_argument);
}

TEST(OctreeIo, BadFilesAreRefusedByName) {
  EXPECT_THAT(error_of("/no/such/map.bt"), HasSubstr("/no/such/map.bt: cannot be opened"));
  TemporaryFile file;
  file.write("solid stl");
  EXPECT_THAT(error_of(file.path), HasSubstr("is not an OctoMap file"));
  file.write("# Octomap OcTree binary file\nid ColorOcTree\nsize 1\nres 0.1\ndata\n");
  EXPECT_THAT(error_of(file.path), HasSubstr("'ColorOcTree'"));
  file.write("# Octomap OcTree binary file\nid OcTree\nsize 1\ndata\n");
  EXPECT_THAT(error_of(file.path), HasSubstr("no resolution"));
  file.write("# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n\x03");
  EXPECT_THAT(error_of(file.path), HasSubstr("not exactly one octree"));
  EXPECT_THROW(write_octree(random_tree(6), "/no/such/map.bt"), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
