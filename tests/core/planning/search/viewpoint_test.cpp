// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/viewpoint.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/search/search_world.hpp"

namespace foretrack {
namespace {

struct Scene {
  GridMap map = known_map(testing::wall_with_doors({5.0}), 0.15);
  SearchGround ground;
  CloudFuture future;
  SearchParams params;
  DistanceField reach;
  Scene() {
    reserve(reach);
    std::ranges::fill(reach.steps, std::uint16_t{1});
    begin_ground(ground, map, {0.0, 2.0, 1.2});
    future.weight.fill(1.0 / CloudFuture::kWalkers);
    for (auto& walker : future.at_m) walker.fill(Vec2(5.0, 3.0));  // stands beyond the door
  }
  Viewpoint judge(const Vec2& at, double arrival_s) const {
    return judge_viewpoint(future, ground, reach, at, arrival_s, 1.4, params);
  }
};

TEST(Viewpoint, APlaceThatSeesThroughTheDoorIsWorthMore) {
  const Scene scene;
  const Viewpoint good = scene.judge({5.0, -1.5}, 0.0), bad = scene.judge({1.0, -1.5}, 0.0);
  EXPECT_GT(good.worth, 0.8);
  EXPECT_EQ(bad.worth, 0.0);
  EXPECT_NEAR(wrap_angle(good.gaze_rad - 0.5 * kPi), 0.0, 0.5);
}

TEST(Viewpoint, SoonerIsBetter) {
  const Scene scene;
  EXPECT_NEAR(scene.judge({5.0, -1.5}, 6.0).worth / scene.judge({5.0, -1.5}, 0.0).worth,
              std::exp(-5.7 / scene.params.search_patience_s), 0.05);
}

TEST(Viewpoint, WalkersGoOnInTheFuture) {
  Scene scene;
  PersonCloud cloud;
  reserve(cloud);
  begin_cloud(cloud, scene.ground, testing::belief_of({0.0, 2.0, 1.2}, {1.0, 0.0, 0.0}, 0.0), 0.1,
              scene.params);
  foresee(cloud, scene.ground, scene.future);
  double moved_m = 0.0;
  for (const auto& walker : scene.future.at_m) moved_m += (walker[3] - walker[0]).norm();
  EXPECT_GT(moved_m / CloudFuture::kWalkers, 1.0);
}

TEST(Viewpoint, NearIsOnlyWhoIsInSight) {
  Scene scene;
  EXPECT_TRUE(may_be_near(scene.ground, {0.0, 1.5}, 1.5));
  spread(scene.ground, 0.5);
  EXPECT_FALSE(may_be_near(scene.ground, {0.0, -0.5}, 3.0)) << "the wall is between";
}

}  // namespace
}  // namespace foretrack
