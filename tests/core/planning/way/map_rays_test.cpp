// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/map_rays.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;
using testing::forest;

TEST(MapRays, SeesWhatTheCellTraversalSees) {
  int disagree = 0, rays = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const GridMap map = known_map(forest(seed, 40), 0.15);
    Random random(seed);
    const auto place = [&] {
      return Vec3(random.uniform(-7, 7), random.uniform(-7, 7), random.uniform(0.5, 2.5));
    };
    for (int i = 0; i < 400; ++i, ++rays) {
      const Vec3 a = place(), b = place();
      const bool exact = line_of_sight(map, a, b), fast = sees(map, a, b, 0.0);
      disagree += exact != fast;
      EXPECT_TRUE(fast || !exact) << "blocked although no cell lies on the segment";
    }
  }
  EXPECT_LT(disagree, rays / 50);  // corners that are cut by less than half a cell
}

TEST(MapRays, ClearMeansThatEveryPointKeepsTheDistance) {
  const GridMap map = known_map(forest(3, 30), 0.15);
  Random random(3);
  int clear = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a(random.uniform(-7, 7), random.uniform(-7, 7), 1.5);
    const Vec3 b =
        a + Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 0.5));
    if (!is_clear(map, a, b, 0.4)) continue;
    ++clear;
    for (double part = 0.0; part <= 1.0; part += 0.002)
      ASSERT_GE(map.unfree_distance_m(a + part * (b - a)), 0.4);
  }
  EXPECT_GT(clear, 100);
}

TEST(MapRays, ThePersonDoesNotHideTheirself) {
  World world = empty_world();
  world.cylinders.push_back({{0.0, 0.0}, 0.2, 1.8, 0.0});
  const GridMap map = known_map(world, 0.1);
  const Vec3 person(0.0, 0.0, 1.0), vehicle(2.0, 0.0, 1.5);
  EXPECT_FALSE(sees(map, person, vehicle, 0.0));
  EXPECT_TRUE(sees(map, person, vehicle, 0.35));
}

TEST(MapRays, OutsideTheMapNothingIsClearAndNothingHides) {
  const GridMap map = known_map(empty_world(), 0.15);
  EXPECT_TRUE(sees(map, {0.0, 0.0, 1.0}, {20.0, 0.0, 1.0}, 0.0));
  EXPECT_FALSE(is_clear(map, {0.0, 0.0, 1.0}, {20.0, 0.0, 1.0}, 0.1));
}

}  // namespace
}  // namespace foretrack
