// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/scenario.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace foretrack {
namespace {

TEST(WorldOf, HasTheGivenShapesAndTheGeneratedOnesAndKeepsTheRouteFree) {
  Scenario scenario;
  scenario.world.boxes = {{{1, 1, 0}, {2, 2, 3}}};
  scenario.world.cylinders = {{{-4, 4}, 0.5, 3.0, 0.0}};
  scenario.generator = {WorldKind::kBoxes, 60, 3};
  scenario.target.route_m = {{-10, 0}, {10, 0}};
  const World world = world_of(scenario);
  ASSERT_GT(world.boxes.size(), 20U);
  EXPECT_EQ(world.boxes[0].max_m, Vec3(2, 2, 3)) << "given ones come first";
  EXPECT_EQ(world.cylinders.size(), 1U);
  for (std::size_t i = 1; i < world.boxes.size(); ++i) {
    World one;
    one.boxes = {world.boxes[i]};
    EXPECT_GE(ground_clearance_m(one, {-10, 0}, {10, 0}), 1.0);
  }
}

TEST(WalkOf, FollowsTheGivenRouteAtTheGivenSpeed) {
  Scenario scenario;
  scenario.target.route_m = {{0, 0}, {9, 0}};
  scenario.target.speed_m_s = 1.2;
  const Walk walk = walk_of(scenario, world_of(scenario));
  EXPECT_EQ(walk.at(0.0).position_m, Vec2(0, 0));
  EXPECT_LT((walk.at(walk.duration_s()).position_m - Vec2(9, 0)).norm(), 1e-9);
  EXPECT_NEAR(walk.at(0.5 * walk.duration_s()).velocity_m_s.x(), 1.2, 1e-9);
}

TEST(WalkOf, ARecordedTrackGoesBeforeARoute) {
  Scenario scenario;
  scenario.target.route_m = {{0, 0}, {9, 0}};
  scenario.target.track = {{0.0, {1, 1}}, {1.0, {2, 1}}, {2.0, {2, 3}}};
  const Walk walk = walk_of(scenario, world_of(scenario));
  EXPECT_LT((walk.at(1.0).position_m - Vec2(2, 1)).norm(), 1e-9);
  EXPECT_NEAR(walk.duration_s(), 2.0, 1e-12);
}

TEST(WalkOf, WithoutEitherARouteIsMadeThatLastsTheFlightAndFollowsTheSeed) {
  Scenario scenario;
  scenario.duration_s = 30.0;
  const auto walk = [&](std::uint64_t seed, WorldKind kind) {
    scenario.seed = seed;
    scenario.generator.kind = kind;
    return walk_of(scenario, world_of(scenario));
  };
  for (const WorldKind kind : {WorldKind::kEmpty, WorldKind::kBoxes, WorldKind::kTIntersection}) {
    const Walk a = walk(1, kind), again = walk(1, kind), b = walk(2, kind);
    EXPECT_GE(a.duration_s(), 30.0);
    EXPECT_EQ(a.at(20.0).position_m, again.at(20.0).position_m);
    EXPECT_NE(a.at(20.0).position_m, b.at(20.0).position_m);
  }
}

TEST(WalkOf, RefusesAWorldWithoutAWay) {
  Scenario scenario;
  scenario.world.boxes = {{scenario.world.min_m, scenario.world.max_m}};
  EXPECT_THROW(walk_of(scenario, world_of(scenario)), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
