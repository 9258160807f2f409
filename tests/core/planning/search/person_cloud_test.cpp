// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/person_cloud.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/search/search_world.hpp"

namespace foretrack {
namespace {

struct Cloud {
  GridMap map;
  SearchGround ground;
  PersonCloud cloud;
  SearchParams params;
  Cloud(const World& world, const Vec3& at, const Vec3& velocity, double age_s)
      : map(known_map(world, 0.15)) {
    begin_ground(ground, map, at);
    spread(ground, 2.0 * age_s);
    reserve(cloud);
    begin_cloud(cloud, ground, testing::belief_of(at, velocity, 0.0), age_s, params);
  }
  void walk(double time_s) {
    for (double t = 0.0; t < time_s; t += 0.1) {
      for (int i = 0; i < 3; ++i) plan_errands(cloud, ground);
      spread(ground, 0.2);
      walk_on(cloud, ground, 0.1);
    }
  }
  template <class Where>
  double belief(Where where) const {
    double sum = 0.0;
    for (const Walker& w : cloud.walkers)
      if (where(w.at_m)) sum += w.weight;
    return sum;
  }
};

TEST(PersonCloud, BeginsOnTheBelievedPathAndNeverBehindAWall) {
  const Cloud c(testing::wall_with_doors({5.0}), {0.0, -1.5, 1.2}, {0.0, 1.2, 0.0}, 1.5);
  EXPECT_NEAR(c.belief([](const Vec2&) { return true; }), 1.0, 1e-9);
  EXPECT_EQ(c.belief([](const Vec2& p) { return p.y() > 0.0; }), 0.0) << "the wall is shut here";
  EXPECT_GT(c.belief([](const Vec2& p) { return p.norm() < 1.2; }), 0.8);
}

TEST(PersonCloud, WalkersLeaveThroughDoorsAndKeepOutOfWalls) {
  Cloud c(testing::wall_with_doors({5.0}), {3.0, 1.5, 1.2}, {1.2, 0.0, 0.0}, 0.5);
  c.walk(12.0);
  EXPECT_GT(c.belief([](const Vec2& p) { return p.y() < -0.2; }), 0.05);
  EXPECT_GT(c.belief([](const Vec2& p) { return p.y() > 0.5; }), 0.2);
  for (const Walker& w : c.cloud.walkers)
    EXPECT_TRUE(c.ground.is_walkable(c.ground.cell_of(w.at_m)));
}

TEST(PersonCloud, LookingInVainLowersTheBeliefThere) {
  Cloud c(testing::empty_world(12.0), {3.0, 0.0, 1.2}, {0.0, 1.0, 0.0}, 0.5);
  c.walk(4.0);
  const auto ahead = [](const Vec2& p) { return p.norm() < 5.9 && std::abs(yaw_of(p)) < 0.6; };
  const double before = c.belief(ahead);
  ASSERT_GT(before, 0.1);
  for (int i = 0; i < 8; ++i) look_in_vain(c.cloud, c.ground, {0.0, 0.0}, 0.0, 0.7, c.params);
  EXPECT_LT(c.belief(ahead), 0.05 * before);
  EXPECT_NEAR(c.belief([](const Vec2&) { return true; }), 1.0, 1e-9);
}

TEST(PersonCloud, WhoIsNowhereIsBelievedAnywhereTheyCanBe) {
  Cloud c(testing::empty_world(12.0), {3.0, 0.0, 1.2}, {0.0, 0.0, 0.0}, 0.2);
  spread(c.ground, 9.0);
  for (int i = 0; i < 60; ++i) {
    look_in_vain(c.ground, {0.0, 0.0}, 0.0, 0.7, 6.0);
    look_in_vain(c.cloud, c.ground, {0.0, 0.0}, 0.0, 0.7, c.params);
  }
  EXPECT_GT(c.belief([](const Vec2& p) { return p.norm() > 6.0 || std::abs(yaw_of(p)) > 0.6; }),
            0.9);
}

TEST(PersonCloud, TheLikeliestPlaceIsInTheCrowd) {
  const Cloud c(testing::empty_world(12.0), {3.0, 2.0, 1.2}, {0.0, 0.0, 0.0}, 0.2);
  EXPECT_LT((likeliest_place_m(c.cloud) - Vec2(3.0, 2.0)).norm(), 0.5);
}

}  // namespace
}  // namespace foretrack
