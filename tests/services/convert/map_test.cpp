// SPDX-License-Identifier: Apache-2.0
#include "services/convert/map.hpp"

#include <cstring>
#include <sstream>

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using M = foretrack_msgs::msg::LocalMap;

GridMap map() {
  GridMap m;
  m.stamp_s = 9.5;
  m.resolution_m = 0.2;
  m.origin_enu_m = {-1, -2, 0};
  m.size = {4, 3, 2};
  for (std::size_t i = 0; i < m.cell_count(); ++i) m.cells.push_back(i % 3);
  DistanceWorkspace workspace;
  update_distances(m, workspace);
  return m;
}

M message(const GridMap& m) {
  M msg;
  to_idl(m, msg);
  return msg;
}

TEST(LocalMapMessage, RoundTrips) {
  const GridMap in = map();
  const auto out = from_idl(message(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->resolution_m, in.resolution_m);
  EXPECT_EQ(out->origin_enu_m, in.origin_enu_m);
  EXPECT_EQ(out->size, in.size);
  EXPECT_EQ(out->cells, in.cells);
  EXPECT_EQ(out->occupied_distance_cm, in.occupied_distance_cm);
  EXPECT_EQ(out->unfree_distance_cm, in.unfree_distance_cm);
}

TEST(LocalMapMessage, MovesItsCells) {
  M msg = message(map());
  const std::uint8_t* cells = msg.cells().data();
  const auto out = from_idl(std::move(msg));
  ASSERT_TRUE(out);
  EXPECT_EQ(out->cells.data(), cells);
}

TEST(LocalMapMessage, RefusesEachBadField) {
  testing::expect_each_refused<M>(
      message(map()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"resolution_m", [](M& m) { m.resolution_m(0.0); }},
              {"resolution_m", [](M& m) { m.resolution_m(kNaN); }},
              {"origin_m", [](M& m) { m.origin_m()[2] = kInf; }},
              {"size_x", [](M& m) { m.size_x(0); }},
              {"size_y", [](M& m) { m.size_y(4'000'000'000u); }},
              {"size", [](M& m) { m.size_x(4'000'000), m.size_y(4'000'000), m.size_z(1024); }},
              {"cells", [](M& m) { m.cells().pop_back(); }},
              {"cells", [](M& m) { m.size_z(3); }},
              {"cells", [](M& m) { m.cells()[7] = 3; }},
              {"occupied_distance_cm", [](M& m) { m.occupied_distance_cm().clear(); }},
              {"unfree_distance_cm", [](M& m) { m.unfree_distance_cm().push_back(0); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(OctomapMessage, IsReadBackAsTheSameCells) {
  octomap::OcTree tree(0.2), read(0.2);
  tree.updateNode(octomap::point3d(1.1f, 0.3f, 0.5f), true);
  tree.updateNode(octomap::point3d(2.1f, 0.3f, 0.5f), false);
  octomap_msgs::msg::Octomap msg;
  to_idl(tree, 4.0, msg);
  EXPECT_TRUE(msg.binary());
  EXPECT_EQ(msg.id(), "OcTree");
  EXPECT_EQ(msg.resolution(), 0.2);
  std::stringstream stream(std::string(msg.data().begin(), msg.data().end()));
  read.readBinaryData(stream);
  EXPECT_TRUE(read.isNodeOccupied(read.search(1.1, 0.3, 0.5)));
  EXPECT_FALSE(read.isNodeOccupied(read.search(2.1, 0.3, 0.5)));
  EXPECT_EQ(read.search(3.1, 0.3, 0.5), nullptr);
}

TEST(PointsMessage, HoldsTheCentresOfOccupiedCells) {
  const GridMap in = map();
  sensor_msgs::msg::PointCloud2 msg;
  to_points(in, msg);
  EXPECT_EQ(msg.width(), 8u);  // every third of 24 cells
  ASSERT_EQ(msg.data().size(), 8u * msg.point_step());
  float first[3];
  std::memcpy(first, msg.data().data(), sizeof first);
  EXPECT_TRUE(in.is_occupied({first[0], first[1], first[2]}));
  EXPECT_NEAR(first[0], -0.7, 1e-6);  // cell (1, 0, 0)
}

}  // namespace
}  // namespace foretrack
