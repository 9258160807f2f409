// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/corridor.hpp"

#include <gtest/gtest.h>

#include "core/planning/way/map_rays.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;
using testing::forest;

struct Case {
  GridMap map;
  Vec3 from, to;
};

// A clear segment in a random forest.
Case random_case(std::uint64_t seed) {
  Case c{known_map(forest(seed, 60), 0.15), {}, {}};
  Random random(seed);
  do {
    c.from = {random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(1.0, 2.0)};
    c.to = c.from + Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.3, 0.3));
  } while (!is_clear(c.map, c.from, c.to, 0.4));
  return c;
}

TEST(Corridor, APolytopeHoldsItsSegmentAndOnlyPlacesThatPassTheCheck) {
  CorridorWorkspace workspace;
  const CorridorParams params;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = random_case(seed);
    Polytope polytope;
    ASSERT_TRUE(decompose_segment(c.map, c.from, c.to, params, workspace, polytope));
    for (double part = 0.0; part <= 1.0; part += 0.05)
      EXPECT_TRUE(polytope.contains(c.from + part * (c.to - c.from))) << "seed " << seed;
    Random random(seed);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p =
          c.from + Vec3(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-1, 1));
      if (!polytope.contains(p, -2e-3)) continue;
      EXPECT_GE(c.map.unfree_distance_m(p), params.vehicle_radius_m) << "seed " << seed;
    }
  }
}

TEST(Corridor, LeavesRoomAroundTheEndsOfEachSegment) {
  CorridorWorkspace workspace;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = random_case(seed);
    Polytope polytope;
    ASSERT_TRUE(decompose_segment(c.map, c.from, c.to, {}, workspace, polytope));
    for (const auto& plane : polytope.planes) {
      EXPECT_NEAR(plane.head<3>().norm(), 1.0, 1e-9);
      // Neighbours share a vertex, so they overlap by at least this.
      EXPECT_LT(plane.head<3>().dot(c.to), plane[3] - 0.01) << "seed " << seed;
    }
  }
}

TEST(Corridor, InTheOpenIsItsWholeBox) {
  CorridorWorkspace workspace;
  const GridMap map = known_map(empty_world(), 0.15);
  Polytope polytope;
  ASSERT_TRUE(
      decompose_segment(map, {0, 0, 1.5}, {2, 0, 1.5}, {0.3, 1.2, 0.5}, workspace, polytope));
  EXPECT_EQ(polytope.planes.size(), 6U);
  EXPECT_TRUE(polytope.contains({3.15, 1.15, 1.95}));
  EXPECT_FALSE(polytope.contains({3.25, 0.0, 1.5}));
}

TEST(Corridor, KeepsOffTheEdgeOfTheMapAndOffUnknownSpace) {
  CorridorWorkspace workspace;
  const GridMap map =
      testing::partly_known_map(empty_world(), 0.15, [](const Vec3& p) { return p.y() < 1.0; });
  Polytope polytope;
  ASSERT_TRUE(decompose_segment(map, {6.9, 0, 1.5}, {7.2, 0, 1.5}, {}, workspace, polytope));
  EXPECT_FALSE(polytope.contains({7.8, 0.0, 1.5}));
  EXPECT_FALSE(polytope.contains({7.0, 0.75, 1.5}));
  EXPECT_TRUE(polytope.contains({7.0, 0.5, 1.5}));
}

TEST(Corridor, SaysWhenTheSegmentItselfIsBlocked) {
  CorridorWorkspace workspace;
  World world = empty_world();
  world.boxes.push_back({{1.0, -1.0, 0.0}, {1.4, 1.0, 4.0}});
  const GridMap map = known_map(world, 0.15);
  Polytope polytope;
  EXPECT_FALSE(decompose_segment(map, {0, 0, 1.5}, {2, 0, 1.5}, {}, workspace, polytope));
  for (const auto& plane : polytope.planes) EXPECT_TRUE(plane.allFinite());
}

TEST(Corridor, ASegmentOfNoLengthHasARoomOfItsOwn) {
  CorridorWorkspace workspace;
  const GridMap map = known_map(forest(2, 20), 0.15);
  Polytope polytope;
  EXPECT_TRUE(decompose_segment(map, {0, 0, 1.5}, {0, 0, 1.5}, {}, workspace, polytope));
  EXPECT_TRUE(polytope.contains({0, 0, 1.5}));
}

}  // namespace
}  // namespace foretrack
