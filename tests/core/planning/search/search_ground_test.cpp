// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_ground.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/search/search_world.hpp"

namespace foretrack {
namespace {

struct Ground : SearchGround {
  GridMap map;
  Ground(const World& world, const Vec2& at) : map(known_map(world, 0.15)) {
    begin_ground(*this, map, {at.x(), at.y(), 1.2});
  }
  bool may_be_at(double x, double y) const { return may_be[cell_of({x, y})] != 0; }
};

TEST(SearchGround, PeopleSpreadAroundWallsAndThroughDoors) {
  Ground g(testing::wall_with_doors({5.0}), {0.0, 2.0});
  EXPECT_TRUE(g.may_be_at(0.0, 2.0));
  spread(g, 3.0);
  EXPECT_TRUE(g.may_be_at(2.5, 2.0));
  EXPECT_TRUE(g.may_be_at(0.0, 4.5));
  EXPECT_FALSE(g.may_be_at(0.0, -0.5)) << "no way through the wall";
  EXPECT_FALSE(g.may_be_at(4.0, 2.0)) << "no farther than they can have come";
  spread(g, 5.0);
  EXPECT_TRUE(g.may_be_at(5.0, -1.0)) << "the door";
  EXPECT_FALSE(g.may_be_at(0.0, -0.5));
}

TEST(SearchGround, NobodyIsWhereItWasLookedInVainButBehindWhatHides) {
  Ground g(testing::wall_with_doors({5.0}), {0.0, 2.0});
  spread(g, 20.0);
  const Vec2 eye(-3.0, -2.0);
  ASSERT_TRUE(g.may_be_at(0.0, -2.0) && g.may_be_at(-6.0, -2.0) && g.may_be_at(0.0, 2.0));
  look_in_vain(g, eye, 0.0, 0.7, 6.0);
  look_in_vain(g, eye, 0.0, 0.7, 6.0);
  EXPECT_TRUE(g.may_be_at(0.0, -2.0)) << "two looks may miss them";
  look_in_vain(g, eye, 0.0, 0.7, 6.0);
  EXPECT_FALSE(g.may_be_at(0.0, -2.0));
  EXPECT_TRUE(g.may_be_at(-6.0, -2.0)) << "behind the camera";
  EXPECT_TRUE(g.may_be_at(0.0, 2.0)) << "behind the wall";
  EXPECT_TRUE(g.may_be_at(4.0, -2.0)) << "too far";
  spread(g, 8.0);
  EXPECT_TRUE(g.may_be_at(0.0, -2.0)) << "they can have come since";
}

TEST(SearchGround, ItIsFreeAheadAsFarAsNobodyCanBe) {
  Ground g(testing::empty_world(12.0), {6.0, 0.0});
  EXPECT_NEAR(free_ahead_m(g, {0.0, 0.0}, 0.0, 0.5, 8.0), 6.0, 0.2);
  EXPECT_EQ(free_ahead_m(g, {0.0, 0.0}, kPi, 0.5, 8.0), 8.0);
  spread(g, 2.0);
  EXPECT_NEAR(free_ahead_m(g, {0.0, 0.0}, 0.0, 0.5, 8.0), 4.0, 0.3);
}

TEST(SearchGround, WallsHideAndDoorsDoNot) {
  Ground g(testing::wall_with_doors({5.0}), {0.0, 2.0});
  EXPECT_FALSE(is_in_sight(g, {0.0, -2.0}, {0.0, 2.0}));
  EXPECT_TRUE(is_in_sight(g, {5.0, -2.0}, {5.0, 2.0}));
  EXPECT_TRUE(is_in_sight(g, {0.0, -2.0}, {3.0, -1.0}));
}

TEST(SearchGround, BeyondAKnownMapIsNothingAndTheUnknownMayBeWalked) {
  Ground known(testing::empty_world(4.0), {0.0, 0.0});
  EXPECT_FALSE(known.is_walkable(known.cell_of({5.0, 0.0})));
  SearchGround g;
  GridMap map = known_map(testing::empty_world(4.0), 0.15);
  map.stamp_s = 3.0;
  begin_ground(g, map, {0.0, 0.0, 1.2});
  EXPECT_TRUE(g.is_walkable(g.cell_of({5.0, 0.0})));
  EXPECT_EQ(g.cell_of({100.0, 0.0}), -1);
}

}  // namespace
}  // namespace foretrack
