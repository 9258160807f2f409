// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/route.hpp"

#include <gtest/gtest.h>

#include "core/simulator/generate_world.hpp"
#include "core/simulator/walk.hpp"

namespace foretrack {
namespace {

double length_of(const std::vector<Vec2>& route) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) length_m += (route[i] - route[i - 1]).norm();
  return length_m;
}

TEST(GenerateRoute, WalksAreFreeForThePersonInEveryKindOfWorld) {
  for (int k = 0; k < static_cast<int>(kWorldKindNames.size()); ++k)
    for (const std::uint64_t seed : {1, 2, 3}) {
      const World world = generate_world({static_cast<WorldKind>(k), 120, seed});
      const RouteRequest request{.seed = seed, .length_m = 80.0};
      const auto route =
          world.boxes.size() == 3 ? t_intersection_route(request) : generate_route(world, request);
      EXPECT_GE(length_of(route), 80.0) << kWorldKindNames[k] << " " << seed;
      const Walk walk = walk_along(route, {2.0, 3.0, 0.45});
      for (double t = 0.0; t < walk.duration_s(); t += 0.02)
        ASSERT_GE(ground_clearance_m(world, walk.at(t).position_m), 0.3)
            << kWorldKindNames[k] << " " << seed << " at " << t;
    }
}

TEST(GenerateRoute, TurnsSharply) {
  const World world = generate_world({WorldKind::kBoxes, 120, 510});
  int sharp = 0, turns = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto route = generate_route(world, {.seed = seed, .length_m = 100.0});
    for (std::size_t i = 2; i < route.size(); ++i) {
      const Vec2 in = route[i - 1] - route[i - 2], out = route[i] - route[i - 1];
      const double turn = std::abs(wrap_angle(yaw_of(out) - yaw_of(in)));
      ++turns;
      sharp += turn >= rad(50.0) && turn <= rad(135.0) + 1e-9;
    }
  }
  EXPECT_GT(turns, 50);
  EXPECT_GE(sharp, 0.95 * turns);
}

TEST(GenerateRoute, FollowsTheSeed) {
  const World world = generate_world({WorldKind::kBoxes, 60, 1});
  EXPECT_EQ(generate_route(world, {.seed = 4}), generate_route(world, {.seed = 4}));
  EXPECT_NE(generate_route(world, {.seed = 4}), generate_route(world, {.seed = 5}));
}

TEST(GenerateRoute, RefusesAWorldWithoutAWay) {
  World world;
  world.boxes.push_back({world.min_m, world.max_m});
  EXPECT_THROW(generate_route(world, {}), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
