// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/local_box.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "core/mapping/octree_cells.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

MappingParams small() {
  MappingParams params;
  params.resolution_m = 0.25;
  params.box_width_m = 3.0;
  params.box_height_m = 1.5;
  params.scroll_step_m = 0.5;
  return params;
}

struct Boxed {
  MappingParams params = small();
  MappingState state{params};
  Boxed() { state.map.cells.resize(state.map.cell_count()); }

  bool follow(const Vec3& vehicle) { return follow_vehicle(state, vehicle, params); }
  // What the octree says of each cell of the box.
  void expect_the_octrees_cells() const {
    for (int z = 0; z < state.map.size.z(); ++z)
      for (int y = 0; y < state.map.size.y(); ++y)
        for (int x = 0; x < state.map.size.x(); ++x) {
          const auto* node = state.tree->search(key_of(state.base + Vec3i(x, y, z)));
          Cell expected = Cell::kUnknown;
          if (node) expected = state.tree->isNodeOccupied(node) ? Cell::kOccupied : Cell::kFree;
          const std::size_t offset = state.map.offset_of({x, y, z});
          ASSERT_EQ(static_cast<Cell>(state.map.cells[offset]), expected) << x << y << z;
          ASSERT_EQ(state.log_odds[offset] == kUnknownLogOdds, expected == Cell::kUnknown);
        }
  }
};

TEST(LocalBox, HasTheStatedSizeInWholeCellsAndAtLeastOne) {
  MappingParams params = small();
  EXPECT_EQ(box_size(params), Vec3i(12, 12, 6));
  params.box_width_m = 3.1;
  EXPECT_EQ(box_size(params).x(), 12);
  params.box_height_m = 0.01;
  EXPECT_EQ(box_size(params).z(), 1);
}

TEST(LocalBox, LogOddsAreStepsOfATwentiethAndSaturate) {
  EXPECT_EQ(log_odds_steps(0.85), 17);
  EXPECT_EQ(log_odds_steps(-0.4), -8);
  EXPECT_EQ(log_odds_steps(100.0), 127);
  EXPECT_EQ(log_odds_steps(-100.0), -127) << "−128 is kept for what is not known";
}

TEST(LocalBox, FollowsOnlyAVehicleThatIsAScrollStepFromItsCentre) {
  Boxed b;
  EXPECT_TRUE(b.follow({0.1, 0.2, 1.0}));
  const Vec3 origin = b.state.map.origin_enu_m;
  EXPECT_FALSE(b.follow({0.5, 0.2, 1.0}));
  EXPECT_EQ(b.state.map.origin_enu_m, origin);
  EXPECT_TRUE(b.follow({0.8, 0.2, 1.0}));
  EXPECT_GT(b.state.map.origin_enu_m.x(), origin.x());
}

TEST(LocalBox, TheVehicleStaysInTheMiddleWhereverItFlies) {
  Boxed b;
  Random random(1);
  Vec3 vehicle(0.0, 0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    b.follow(vehicle);
    const Vec3 middle =
        b.state.map.origin_enu_m + 0.5 * b.params.resolution_m * b.state.map.size.cast<double>();
    EXPECT_LE((vehicle - middle).cwiseAbs().maxCoeff(), b.params.scroll_step_m + 1e-9);
    EXPECT_NEAR(
        (b.state.map.origin_enu_m / b.params.resolution_m - b.state.base.cast<double>()).norm(),
        0.0, 1e-9);
    vehicle +=
        Vec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.2, 0.2));
  }
}

// Cells are set at random while the box moves by little, by much, and beyond what it held.
TEST(LocalBox, HoldsWhatTheOctreeKnowsWhereverItMoves) {
  Boxed b;
  Random random(2);
  b.follow({0.0, 0.0, 1.0});
  for (int round = 0; round < 60; ++round) {
    for (int i = 0; i < 60; ++i)
      set_log_odds(b.state,
                   static_cast<std::size_t>(
                       random.integer(0, static_cast<int>(b.state.log_odds.size()) - 1)),
                   static_cast<std::int8_t>(random.integer(-40, 50)));
    b.expect_the_octrees_cells();
    const double reach_m = round % 10 == 9 ? 5.0 : 1.0;
    b.follow({random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m),
              random.uniform(0.5, 1.5)});
    b.expect_the_octrees_cells();
  }
}

TEST(LocalBox, LogOddsStayWhereTheBoxStillIs) {
  Boxed b;
  b.follow({0.0, 0.0, 1.0});
  const Vec3 place = b.state.map.center_of({9, 6, 3});
  set_log_odds(b.state, b.state.map.offset_of({9, 6, 3}), 7);
  b.follow({0.8, 0.0, 1.0});
  EXPECT_EQ(b.state.log_odds[b.state.map.offset_of(b.state.map.index_of(place))], 7);
}

TEST(LocalBox, SaysWhetherACellBecameSomethingElse) {
  Boxed b;
  b.follow({0.0, 0.0, 1.0});
  const std::size_t offset = b.state.map.offset_of({2, 3, 4});
  EXPECT_TRUE(set_log_odds(b.state, offset, -8)) << "unknown → free";
  EXPECT_FALSE(set_log_odds(b.state, offset, -16));
  EXPECT_TRUE(set_log_odds(b.state, offset, 0)) << "even odds are occupied";
  EXPECT_FALSE(set_log_odds(b.state, offset, 50));
}

TEST(LocalBox, ReloadsAllOfItFromTheOctree) {
  Boxed b;
  b.follow({0.0, 0.0, 1.0});
  for (int x = 0; x < 12; ++x)
    b.state.tree->setNodeValue(key_of(b.state.base + Vec3i(x, x, x / 2)),
                               b.state.tree->getClampingThresMaxLog());
  reload_box(b.state, b.params);
  b.expect_the_octrees_cells();
  EXPECT_EQ(b.state.map.cell_at(b.state.map.center_of({5, 5, 2})), Cell::kOccupied);
}

TEST(LocalBox, StopsAtTheEdgeOfTheOctree) {
  Boxed b;
  EXPECT_TRUE(b.follow({1e6, -1e6, 1.0}));
  EXPECT_EQ(b.state.base.x() + b.state.map.size.x(), kTreeCentre);
  EXPECT_GE(b.state.base.y(), -kTreeCentre);
  b.expect_the_octrees_cells();
}

}  // namespace
}  // namespace foretrack
