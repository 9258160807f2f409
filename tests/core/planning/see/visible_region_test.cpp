// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/visible_region.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;
using testing::FlatContext;
using testing::forest;

constexpr double kRegionHeight_m = 1.5;

TEST(VisibleSector, EndsWhereTheLineOfSightIsBlocked) {
  int sectors = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const FlatContext c(known_map(forest(seed, 45, 8.0, 0.4), 0.15), kRegionHeight_m);
    const SearchContext context = c.context();
    const Vec3 target(0.0, 0.0, 1.0);
    const auto visible = [&](double angle_rad) {
      const Vec2 xy = 2.0 * direction_of(angle_rad);
      return line_of_sight(c.map, target, {xy.x(), xy.y(), kRegionHeight_m});
    };
    ViewSector sector;
    const double angle_rad = 0.7 * static_cast<double>(seed);
    const Vec2 xy = 2.0 * direction_of(angle_rad);
    if (!visible_sector(context, target, {xy.x(), xy.y(), kRegionHeight_m}, sector)) {
      EXPECT_FALSE(visible(angle_rad));
      continue;
    }
    ++sectors;
    EXPECT_TRUE(sector.contains(angle_rad));
    // Walk in one-degree steps to the first blocked ray on each side.
    double opening_rad = 0.0;
    for (const double side : {1.0, -1.0}) {
      double edge_rad = 0.0;
      while (edge_rad < 0.5 * kPi && visible(angle_rad + side * (edge_rad + rad(1.0))))
        edge_rad += rad(1.0);
      opening_rad += edge_rad;
    }
    EXPECT_NEAR(2.0 * sector.half_angle_rad, opening_rad, rad(7.0)) << "seed " << seed;
  }
  EXPECT_GT(sectors, 15);
}

TEST(VisibleSector, IsAHalfTurnInTheOpen) {
  const FlatContext c(known_map(empty_world(), 0.15), kRegionHeight_m);
  ViewSector sector;
  ASSERT_TRUE(visible_sector(c.context(), {0.0, 0.0, 1.0}, {0.0, -2.0, kRegionHeight_m}, sector));
  EXPECT_NEAR(sector.bisector_rad, -kPi / 2, 1e-9);
  EXPECT_NEAR(sector.half_angle_rad, kPi / 2, 1e-9);
}

TEST(VisibleSector, DoesNotTakeThePersonForAnObstacle) {
  World world = empty_world();
  world.cylinders.push_back({{0.0, 0.0}, 0.2, 1.8, 0.0});
  const FlatContext c(known_map(world, 0.1), kRegionHeight_m);
  ViewSector sector;
  EXPECT_TRUE(visible_sector(c.context(), {0.0, 0.0, 1.0}, {-2.0, 0.0, kRegionHeight_m}, sector));
  EXPECT_NEAR(sector.half_angle_rad, kPi / 2, 1e-9);
}

TEST(IntentionMargins, LieOnTheSideToWhichTheTargetTurns) {
  PlaceParams params;
  const double north_rad = kPi / 2;
  // A vehicle south of a target that walks north and means to turn left (west): the margin keeps it
  // away from the western side, which is clockwise of south.
  const SectorMargins behind = intention_margins({-kPi / 2, 0.8}, north_rad, 1.0, 0.0, params);
  EXPECT_NEAR(behind.clockwise_rad, params.margin_min_rad + params.margin_extra_rad, 1e-9);
  EXPECT_NEAR(behind.counter_clockwise_rad, params.margin_min_rad, 1e-9);
  // Ahead of it, the west is counter-clockwise of north.
  const SectorMargins ahead = intention_margins({kPi / 2, 0.8}, north_rad, 1.0, 0.0, params);
  EXPECT_NEAR(ahead.counter_clockwise_rad, params.margin_min_rad + params.margin_extra_rad, 1e-9);
  const SectorMargins right = intention_margins({-kPi / 2, 0.8}, north_rad, 0.0, 1.0, params);
  EXPECT_GT(right.counter_clockwise_rad, right.clockwise_rad);
}

TEST(Shrink, MovesEachSideByItsMargin) {
  const ViewSector shrunk = shrink({0.3, 1.0}, {0.4, 0.1}, 0.7);
  EXPECT_NEAR(shrunk.bisector_rad + shrunk.half_angle_rad, 1.3 - 0.4, 1e-12);
  EXPECT_NEAR(shrunk.bisector_rad - shrunk.half_angle_rad, -0.7 + 0.1, 1e-12);
}

TEST(Shrink, LeavesItsShareOfANarrowSector) {
  const ViewSector shrunk = shrink({0.0, 0.1}, {0.5, 0.1}, 0.7);
  EXPECT_NEAR(shrunk.half_angle_rad, 0.03, 1e-12);
  EXPECT_NEAR(shrunk.bisector_rad + shrunk.half_angle_rad, 0.1 - 0.7 * 0.2 * 5.0 / 6.0, 1e-12);
}

TEST(Narrow, KeepsThePartAroundTheWantedDirection) {
  const ViewSector part = narrow({0.5, 1.0}, 1.0, 0.3);
  EXPECT_NEAR(part.bisector_rad, 1.0, 1e-12);
  EXPECT_NEAR(part.half_angle_rad, 0.3, 1e-12);
}

TEST(Narrow, KeepsTheNearestPartWhereTheWantedDirectionIsNotSeen) {
  for (const double side : {1.0, -1.0}) {
    const ViewSector part = narrow({0.0, 1.0}, side * 2.5, 0.3);
    EXPECT_NEAR(part.bisector_rad, side * 0.7, 1e-12);
    EXPECT_NEAR(part.half_angle_rad, 0.3, 1e-12);
  }
}

TEST(Narrow, LeavesANarrowSectorAsItIs) {
  const ViewSector part = narrow({0.4, 0.1}, 2.0, 0.3);
  EXPECT_NEAR(part.bisector_rad, 0.4, 1e-12);
  EXPECT_NEAR(part.half_angle_rad, 0.1, 1e-12);
}

TEST(RotateInto, TurnsTheWaypointIntoTheSectorAtItsDistance) {
  const FlatContext c(known_map(empty_world(), 0.15), kRegionHeight_m);
  const Vec3 target(1.0, 0.0, 1.0), waypoint(3.0, 0.0, kRegionHeight_m);
  const ViewSector sector{0.5, 0.3};
  const Vec3 moved = rotate_into(c.context(), target, waypoint, sector, 1.0);
  EXPECT_TRUE(sector.contains(yaw_of(Vec2((moved - target).head<2>()))));
  EXPECT_NEAR(distance_xy(moved, target), 2.0, 1e-9);
  const Vec3 little = rotate_into(c.context(), target, waypoint, sector, 0.1);
  EXPECT_NEAR((little - waypoint).norm(), 0.1, 1e-3);
  EXPECT_EQ(rotate_into(c.context(), target, waypoint, {0.1, 0.3}, 1.0), waypoint);
}

TEST(RotateInto, LeavesTheWaypointIfAnObstacleIsThere) {
  World world = empty_world();
  world.cylinders.push_back({Vec2(1.0, 0.0) + 2.2 * direction_of(0.4), 0.3, 4.0, 0.0});
  const FlatContext c(known_map(world, 0.15), kRegionHeight_m);
  const Vec3 waypoint(3.0, 0.0, kRegionHeight_m);
  EXPECT_EQ(rotate_into(c.context(), {1.0, 0.0, 1.0}, waypoint, {0.6, 0.3}, 1.0), waypoint);
}

}  // namespace
}  // namespace foretrack
