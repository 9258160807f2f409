// SPDX-License-Identifier: Apache-2.0
#include "core/safety/flight_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace foretrack {
namespace {

FlightBounds fence(const std::vector<FlightBounds::Corner>& corners) {
  FlightBounds bounds;
  bounds.corner_count = static_cast<int>(corners.size());
  for (std::size_t i = 0; i < corners.size() && i < FlightBounds::kMaxCorners; ++i)
    bounds.corners_enu_m[i] = corners[i];
  return bounds;
}

TEST(FlightBounds, AFenceOfThreeCornersOrMoreIsSoundAndSoIsNone) {
  EXPECT_TRUE(are_valid({}));
  EXPECT_TRUE(are_valid(fence({{0, 0}, {1, 0}, {0, 1}})));
  EXPECT_TRUE(are_valid(fence({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}))) << "need not be convex";
  std::vector<FlightBounds::Corner> many;
  for (int i = 0; i < 32; ++i) many.push_back({std::cos(i * 0.19), std::sin(i * 0.19)});
  EXPECT_TRUE(are_valid(fence(many)));
}

TEST(FlightBounds, AnEdgeThatOnlyPointsAtAnotherOneDoesNotCrossIt) {
  EXPECT_TRUE(are_valid(fence({{4, 4}, {2, 1}, {0, 4}, {0, 0}, {4, 0}})));
}

TEST(FlightBounds, RefusesTooFewOrTooManyCornersAndCrossedEdges) {
  EXPECT_FALSE(are_valid(fence({{0, 0}})));
  EXPECT_FALSE(are_valid(fence({{0, 0}, {1, 1}})));
  EXPECT_FALSE(are_valid(fence(std::vector<FlightBounds::Corner>(33))));
  EXPECT_FALSE(are_valid(fence({{0, 0}, {2, 2}, {2, 0}, {0, 2}})));
  FlightBounds negative;
  negative.corner_count = -1;
  EXPECT_FALSE(are_valid(negative));
}

TEST(FlightBounds, RefusesWhatIsNotFiniteAndAnEmptyBand) {
  EXPECT_FALSE(are_valid(fence({{0, 0}, {1, 0}, {std::nan(""), 1}})));
  EXPECT_FALSE(are_valid(fence({{0, 0}, {1, 0}, {0, INFINITY}})));
  FlightBounds band;
  band.altitude_min_m = 3.0;
  band.altitude_max_m = 3.0;
  EXPECT_FALSE(are_valid(band));
  band.altitude_max_m = std::nan("");
  EXPECT_FALSE(are_valid(band));
  band.altitude_max_m = 5.0;
  EXPECT_TRUE(are_valid(band));
}

}  // namespace
}  // namespace foretrack
