// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/reachable_region.hpp"

#include <gtest/gtest.h>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

MotionCues walking(const Vec2& position_m, const Vec2& velocity_m_s) {
  MotionMemory memory;
  return observe_motion(memory, walker(position_m, velocity_m_s), {});
}

TEST(ReachableRegion, IsTheWholeHalfPlaneInTheOpen) {
  const auto s = observe_surroundings(open_field(), walking({0, 0}, {0.9, 1.2}), {});
  EXPECT_DOUBLE_EQ(s.region.left_half_angle_rad, kPi / 4.0);
  EXPECT_DOUBLE_EQ(s.region.right_half_angle_rad, kPi / 4.0);
  EXPECT_NEAR(s.region.radius_m, 1.5, 0.05);
  EXPECT_DOUBLE_EQ(s.obstacle_distance_m, PredictionParams{}.obstacle_range_m);
}

TEST(ReachableRegion, MatchesTheAngleToAWallBesideTheWay) {
  PredictionParams params;
  params.region_rays_per_side = 90;
  // A wall at y = 1: a circle of radius 2 around the origin meets it at 30°.
  const GridMap map = map_of({{-8, 8, 1, 8}});
  const auto region = reachable_region(map, {0, 0, 1.2}, 0.0, 2.0, params);
  EXPECT_NEAR(2.0 * region.left_half_angle_rad, rad(30.0), rad(3.0));
  EXPECT_DOUBLE_EQ(region.right_half_angle_rad, kPi / 4.0);
}

TEST(ReachableRegion, OpensOnTheSideOfTheCornerBeforeTheTargetGetsThere) {
  const auto s = observe_surroundings(left_branch(), walking({-0.8, 0}, {1.5, 0}), {});
  EXPECT_GT(s.region_ahead.left_half_angle_rad, s.region.left_half_angle_rad + 0.1);
  EXPECT_LE(s.region_ahead.right_half_angle_rad, s.region.right_half_angle_rad + 0.05);
}

TEST(ReachableRegion, LooksNeitherThroughNorBehindAWall) {
  // A thin wall across the way, 0.5 m ahead: constant velocity would lead behind it.
  const GridMap map = map_of({{0.5, 0.7, -8, 8}});
  const auto s = observe_surroundings(map, walking({0, 0}, {2.0, 0}), {});
  EXPECT_NEAR(s.obstacle_distance_m, 0.5, 0.11);
  EXPECT_LT(s.region_ahead.left_half_angle_rad, 0.5 * kPi / 4.0);
  EXPECT_EQ(s.left_width_m[Surroundings::kSideCount - 1], 0.0);  // behind the wall
  EXPECT_GT(s.left_width_m[0], 2.0);
}

TEST(ReachableRegion, TakesUnknownSpaceForOpen) {
  GridMap map = map_of({});
  std::fill(map.cells.begin(), map.cells.end(), static_cast<std::uint8_t>(Cell::kUnknown));
  const auto s = observe_surroundings(map, walking({0, 0}, {1.5, 0}), {});
  EXPECT_DOUBLE_EQ(s.region.left_half_angle_rad, kPi / 4.0);
}

}  // namespace
}  // namespace foretrack
