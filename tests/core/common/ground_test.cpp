// SPDX-License-Identifier: Apache-2.0
#include "core/common/ground.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// 16 × 16 × 4 m around (0, 0), free but for what is_occupied says.
template <class IsOccupied>
GridMap map_of(IsOccupied&& is_occupied) {
  GridMap map;
  map.resolution_m = 0.1;
  map.origin_enu_m = Vec3(-8.0, -8.0, 0.0);
  map.size = {160, 160, 40};
  map.cells.assign(map.cell_count(), static_cast<std::uint8_t>(Cell::kFree));
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x)
        if (is_occupied(map.center_of({x, y, z})))
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
  return map;
}

bool is_beside(const Vec3& p, double half_x_m, double half_y_m) {
  return std::abs(p.x()) < half_x_m && std::abs(p.y()) < half_y_m;
}

TEST(Ground, IsTheTopOfWhatIsBelow) {
  const GridMap map = map_of([](const Vec3& p) { return is_beside(p, 1.0, 1.0) && p.z() < 0.6; });
  EXPECT_NEAR(ground_below_m(map, {0.0, 0.0, 2.0}).value(), 0.6, 1e-9);
  EXPECT_NEAR(ground_below_m(map, {3.0, 0.0, 2.0}).value(), 0.0, 1e-9);
}

// A hedge or a table stands on the ground; a slope and steps are the ground.
TEST(Ground, WhatIsNarrowIsNone) {
  const GridMap hedge = map_of([](const Vec3& p) { return is_beside(p, 0.3, 6.0) && p.z() < 1.3; });
  EXPECT_NEAR(ground_below_m(hedge, {0.0, 0.0, 2.0}).value(), 0.0, 1e-9);
  const GridMap table = map_of([](const Vec3& p) { return is_beside(p, 0.7, 0.5) && p.z() < 0.8; });
  EXPECT_NEAR(ground_below_m(table, {0.2, 0.1, 2.0}).value(), 0.0, 1e-9);
}

TEST(Ground, MaySlopeAndHaveSteps) {
  const GridMap stairs = map_of([](const Vec3& p) {
    return p.x() > -3.0 && p.z() < 0.2 * (1.0 + std::floor((p.x() + 3.0) / 0.4));
  });
  for (double x_m = -2.85; x_m < 2.0; x_m += 0.1)
    EXPECT_NEAR(ground_below_m(stairs, {x_m, 0.0, 3.9}).value(),
                0.2 * (1.0 + std::floor((x_m + 3.0) / 0.4)), 1e-9)
        << x_m;
  EXPECT_NEAR(ground_below_m(stairs, {-3.15, 0.0, 3.9}).value(), 0.0, 1e-9);
}

TEST(Ground, IsNotKnownWhereNobodyHasSeenIt) {
  GridMap map = map_of([](const Vec3&) { return false; });
  const auto layer = static_cast<std::ptrdiff_t>(map.size.x()) * map.size.y();
  std::fill_n(map.cells.begin(), 10 * layer, static_cast<std::uint8_t>(Cell::kUnknown));
  EXPECT_FALSE(ground_below_m(map, {0.0, 0.0, 2.0}));
  EXPECT_FALSE(ground_below_m(map, {90.0, 0.0, 2.0}));
}

// The lower edge of a box that moves with the vehicle is nothing to stand on.
TEST(Ground, IsNotTheEdgeOfALocalMap) {
  GridMap map = map_of([](const Vec3&) { return false; });
  EXPECT_EQ(ground_below_m(map, {0.0, 0.0, 2.0}), 0.0);
  map.stamp_s = 3.0;
  EXPECT_FALSE(ground_below_m(map, {0.0, 0.0, 2.0}));
}

}  // namespace
}  // namespace foretrack
