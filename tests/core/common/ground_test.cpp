// SPDX-License-Identifier: Apache-2.0
#include "core/common/ground.hpp"

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

// A hedge or a table stands on the ground; a slope and steps are the ground.
TEST(Ground, WhatIsNarrowIsNone) {
  World world = testing::empty_world();
  world.boxes.push_back({{-0.3, -6.0, 0.0}, {0.3, 6.0, 1.3}});
  world.boxes.push_back({{3.0, -0.5, 0.0}, {4.0, 0.5, 0.8}});
  const GridMap map = known_map(world, 0.15);
  EXPECT_NEAR(ground_below_m(map, {0.0, 0.0, 2.0}).value(), 0.0, 1e-9);
  EXPECT_NEAR(ground_below_m(map, {3.5, 0.0, 2.0}).value(), 0.0, 1e-9);
}

TEST(Ground, MaySlopeAndHaveSteps) {
  World world = testing::empty_world();
  for (int i = 0; i < 20; ++i)  // stairs, 0.3 m deep and 0.15 m high each
    world.boxes.push_back({{-3.0 + 0.3 * i, -6.0, 0.0}, {4.0, 6.0, 0.15 * (i + 1) - 0.01}});
  const GridMap map = known_map(world, 0.15);
  for (double x_m = -2.0; x_m < 2.0; x_m += 0.1)
    EXPECT_NEAR(ground_below_m(map, {x_m, 0.0, 3.6}).value(), 0.5 * (x_m + 3.0) + 0.08, 0.2) << x_m;
  EXPECT_NEAR(ground_below_m(map, {-3.1, 0.0, 3.6}).value(), 0.0, 1e-9) << "before the first step";
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
