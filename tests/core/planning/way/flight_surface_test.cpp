// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/flight_surface.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;

const PlanningParams kParams;
const Vec3 kSurfaceStart(-2.0, 0.0, 1.3), kSurfaceTarget(0.0, 0.0, 1.2);

double wanted_m() {
  return kSurfaceTarget.z() + kParams.place.height_above_target_m;
}

// The same world with its ground, and what else lies in it.
GridMap room(const std::vector<Box>& boxes = {}) {
  World world = empty_world();
  world.min_m.z() = -0.45;
  world.boxes.push_back({{-8.0, -8.0, -0.45}, {8.0, 8.0, 0.0}});
  world.boxes.insert(world.boxes.end(), boxes.begin(), boxes.end());
  return known_map(world, 0.15);
}

TEST(FlightSurface, LeadsFromTheVehiclesHeightToTheLevelWithoutASteeperSlope) {
  const FlightSurface surface{Vec2(1.0, 0.0), 1.0, 2.0, 1.0};
  EXPECT_FALSE(surface.flat());
  EXPECT_DOUBLE_EQ(surface.z_at({1.0, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(surface.z_at({1.0, 0.4}), 1.4);
  EXPECT_DOUBLE_EQ(surface.z_at({9.0, 0.0}), 2.0);
  const FlightSurface down{Vec2(1.0, 0.0), 2.0, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(down.z_at({1.0, 0.4}), 1.6);
  EXPECT_DOUBLE_EQ(down.at({9.0, 0.0}).z(), 1.0);
}

TEST(FlightSurface, IsTheWantedHeightWhereThatIsFree) {
  const FlightSurface surface =
      choose_flight_surface(room(), kSurfaceStart, kSurfaceTarget, kParams);
  EXPECT_NEAR(surface.level_z_m, wanted_m(), 1e-9);
  EXPECT_EQ(surface.start_z_m, kSurfaceStart.z());
}

TEST(FlightSurface, EvadesToALevelThatIsFreer) {
  const GridMap low_shelf = room({{{-6.0, -6.0, 1.2}, {6.0, 6.0, 1.35}}});
  const FlightSurface surface =
      choose_flight_surface(low_shelf, kSurfaceStart, kSurfaceTarget, kParams);
  EXPECT_GE(std::abs(surface.level_z_m - 1.275), kParams.check.vehicle_radius_m);
  EXPECT_LE(std::abs(surface.level_z_m - wanted_m()), kParams.place.height_search_m + 1e-9);
}

TEST(FlightSurface, IsNeverLowerThanTheLeastAltitude) {
  PlanningParams params;
  params.place.height_above_target_m = -1.0;
  const FlightSurface surface =
      choose_flight_surface(room(), kSurfaceStart, kSurfaceTarget, params);
  EXPECT_NEAR(surface.level_z_m, params.body.least_altitude_m, 0.16);
}

TEST(FlightSurface, OtherLevelsAreFlatAndUpwardsComesFirst) {
  const GridMap map = room();
  const auto first = other_flight_surface(map, kSurfaceStart, kSurfaceTarget, 0, kParams);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->flat());
  EXPECT_GT(first->level_z_m, wanted_m());
  double highest_m = 0.0, lowest_m = 9.0;
  for (int i = 0; i < kOtherLevels; ++i)
    if (const auto other = other_flight_surface(map, kSurfaceStart, kSurfaceTarget, i, kParams)) {
      highest_m = std::max(highest_m, other->level_z_m);
      lowest_m = std::min(lowest_m, other->level_z_m);
    }
  EXPECT_NEAR(highest_m, wanted_m() + kParams.place.height_search_m, 1e-9);
  EXPECT_LT(lowest_m, wanted_m());
}

TEST(FlightSurface, ThereIsNoOtherLevelBeyondACeiling) {
  const GridMap map = room({{{-6.0, -6.0, 1.8}, {6.0, 6.0, 1.95}}});
  EXPECT_FALSE(other_flight_surface(map, kSurfaceStart, kSurfaceTarget, 2, kParams));
}

}  // namespace
}  // namespace foretrack
