// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/hidings.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace foretrack {
namespace {

// A wall along x with a door that the vehicle cannot pass; they are behind it from 2 s to 6 s.
World wall() {
  World world;
  world.min_m = {-10.0, -5.0, 0.0};
  world.max_m = {10.0, 5.0, 4.0};
  world.boxes = {{{-10.0, 0.0, 0.0}, {-0.32, 0.3, 4.0}}, {{0.32, 0.0, 0.0}, {10.0, 0.3, 4.0}}};
  return world;
}

std::vector<FlightRow> rows_of(const std::function<bool(double)>& seen) {
  std::vector<FlightRow> rows;
  for (int i = 0; i <= 1500; ++i) {
    FlightRow& row = rows.emplace_back();
    row.now_s = 0.01 * i;
    row.vehicle.position_enu_m = {-3.0, -2.0, 1.3};
    const bool behind = row.now_s >= 2.0 && row.now_s < 6.0;
    row.target.position_enu_m = {0.0, behind ? 2.0 : -2.0, 1.2};
    row.estimate.position_enu_m = row.target.position_enu_m;
    row.estimate.status = seen(row.now_s) ? TrackStatus::kTracking : TrackStatus::kLost;
    row.sight.in_view = row.sight.unhidden = seen(row.now_s);
  }
  return rows;
}

TEST(Hidings, AreWhileTheVehicleCannotFlyThere) {
  const auto records =
      hidings_of(rows_of([](double t) { return t < 2.0 || t > 9.0; }), wall(), 0.15);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_NEAR(records[0].begin_s, 2.0, 1e-6);
  EXPECT_NEAR(records[0].hidden_s(), 4.0, 0.02);
  EXPECT_NEAR(records[0].until_found_s(), 3.0, 0.02);
  EXPECT_TRUE(records[0].found_within(kFindWithin_s));
  EXPECT_NEAR(records[0].least_gap_m, 3.0 - 0.5, 0.02);
}

TEST(Hidings, AGlimpseIsNotFound) {
  const auto records =
      hidings_of(rows_of([](double t) { return t < 2.0 || (t > 7.0 && t < 7.3); }), wall(), 0.15);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_FALSE(records[0].found_within(kFindWithin_s));
}

TEST(Hidings, WhoIsSeenAllTheWhileIsFoundAtOnce) {
  const auto records = hidings_of(rows_of([](double) { return true; }), wall(), 0.15);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_NEAR(records[0].until_found_s(), 0.0, 1e-9);
}

TEST(Hidings, WhoReappearsTooLateDoesNotCount) {
  auto rows = rows_of([](double t) { return t < 2.0; });
  rows.resize(1300);
  EXPECT_TRUE(hidings_of(rows, wall(), 0.15).empty());
  EXPECT_TRUE(hidings_of({}, wall(), 0.15).empty());
}

}  // namespace
}  // namespace foretrack
