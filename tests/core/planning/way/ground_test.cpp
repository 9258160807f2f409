// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/ground.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

TEST(Ground, IsTheTopOfWhatIsBelow) {
  World world = testing::empty_world();
  world.boxes.push_back({{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.6}});
  const GridMap map = known_map(world, 0.15);
  EXPECT_NEAR(ground_below_m(map, {0.0, 0.0, 2.0}).value(), 0.6, 0.08);
  EXPECT_NEAR(ground_below_m(map, {3.0, 0.0, 2.0}).value(), 0.0, 1e-9);
}

TEST(Ground, IsNotKnownWhereNobodyHasSeenIt) {
  GridMap map = testing::partly_known_map(testing::empty_world(), 0.15,
                                          [](const Vec3& p) { return p.z() > 1.0; });
  EXPECT_FALSE(ground_below_m(map, {0.0, 0.0, 2.0}));
  EXPECT_FALSE(ground_below_m(map, {90.0, 0.0, 2.0}));
}

// The lower edge of a box that moves with the vehicle is nothing to stand on.
TEST(Ground, IsNotTheEdgeOfALocalMap) {
  GridMap map = known_map(testing::empty_world(), 0.15);
  map.stamp_s = 3.0;
  EXPECT_FALSE(ground_below_m(map, {0.0, 0.0, 2.0}));
}

}  // namespace
}  // namespace foretrack
