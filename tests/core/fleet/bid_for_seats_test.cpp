// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/bid_for_seats.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

GridMap map_with(const std::function<bool(const Vec3&)>& occupied) {
  GridMap map;
  map.resolution_m = 0.1;
  map.origin_enu_m = {-10, -10, 0};
  map.size = {200, 200, 20};
  map.cells.resize(map.cell_count());
  for (int z = 0; z < 20; ++z)
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(
            occupied(map.center_of({x, y, z})) ? Cell::kOccupied : Cell::kFree);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

constexpr int kEast = 0, kNorth = 3, kWest = 6, kSouth = 9;

PredictedPath straight(int intention, double probability, const Vec3& velocity) {
  PredictedPath path;
  path.intention = static_cast<Intention>(intention);
  path.probability = probability;
  for (int k = 1; k <= 15; ++k)
    path.states.push_back({0.2 * k, Vec3(0, 0, 1) + 0.2 * k * velocity, velocity, Mat2::Zero()});
  return path;
}

TEST(BidForSeats, InTheOpenEverySeatSees) {
  const auto bids = bid_for_seats({.own_enu_m = {-2, 0, 1.5}, .person_enu_m = {0, 0, 1}}, {});
  for (const SeatBid& bid : bids) EXPECT_TRUE(bid.possible());
  EXPECT_GT(bids[Seat::of(kWest, SeatRing::kNear).number].sees[0], 0.95F);
  EXPECT_LT(bids[Seat::of(kWest, SeatRing::kNear).number].way_s, 0.1F);
  EXPECT_GT(bids[Seat::of(kEast, SeatRing::kNear).number].way_s,
            bids[Seat::of(kNorth, SeatRing::kNear).number].way_s);
}

// A street along x, 2 m wide: places behind and before the person only, and no way past them.
TEST(BidForSeats, InAStreetTheWayIsNotPastThePerson) {
  const GridMap map = map_with([](const Vec3& p) { return std::abs(p.y()) > 1.0; });
  const auto bids =
      bid_for_seats({.own_enu_m = {-2, 0, 1.5}, .person_enu_m = {0, 0, 1}, .map = &map}, {});
  EXPECT_TRUE(bids[Seat::of(kWest, SeatRing::kNear).number].possible());
  EXPECT_TRUE(bids[Seat::of(kWest, SeatRing::kFar).number].possible());
  EXPECT_FALSE(bids[Seat::of(kNorth, SeatRing::kNear).number].possible());
  EXPECT_FALSE(bids[Seat::of(kEast, SeatRing::kNear).number].possible());
}

// A wall behind a corner: whoever is in the south sees a person who goes north, and not one who
// goes east round the corner.
TEST(BidForSeats, SeesByIntention) {
  const GridMap map = map_with([](const Vec3& p) { return p.y() < -0.6 && p.x() > 0.6; });
  Prediction prediction;
  prediction.paths = {straight(0, 0.5, {0, 1.5, 0}), straight(1, 0.5, {1.5, 0, 0}),
                      straight(2, 0.01, {-1.5, 0, 0})};
  const auto bids = bid_for_seats({.own_enu_m = {0, -2, 1.5},
                                   .person_enu_m = {0, 0, 1},
                                   .prediction = &prediction,
                                   .map = &map},
                                  {});
  const SeatBid& south = bids[Seat::of(kSouth, SeatRing::kNear).number];
  EXPECT_GT(south.sees[0], 0.9F);
  EXPECT_LT(south.sees[1], 0.3F);
  EXPECT_EQ(south.sees[2], 0.0F) << "unlikely: not looked at";
  const SeatBid& west = bids[Seat::of(kWest, SeatRing::kNear).number];
  EXPECT_GT(west.sees[1], 0.7F);
}

TEST(SeatDistance, IsAsFarAsWantedOrAsThereIsRoom) {
  const FleetParams params;
  const GridMap map = map_with([](const Vec3& p) { return p.x() > 3.5 || p.y() > 2.0; });
  const Vec3 person(0, 0, 1);
  EXPECT_EQ(seat_distance_m(nullptr, person, 0.0, SeatRing::kFar, 0.25, params), params.far_m);
  const double before_wall = seat_distance_m(&map, person, 0.0, SeatRing::kFar, 0.25, params);
  EXPECT_LT(before_wall, 3.3);
  EXPECT_GE(before_wall, params.far_least_m);
  EXPECT_LT(seat_distance_m(&map, person, 0.5 * kPi, SeatRing::kNear, 0.25, params), 0.0);
}

}  // namespace
}  // namespace foretrack
