// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/run_record.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

// A target that walks along +x at 2 m/s and turns left by 90° at 5 s; at the origin then. The
// vehicle is 2 m behind, and sees it.
FlightResult flight_with_a_turn() {
  FlightResult flight;
  Vec3 place(-10.0, 0.0, 1.2);
  for (int i = 1; i <= 1200; ++i) {
    FlightRow r;
    r.now_s = i * kStep_s;
    const double yaw = kPi / 2.0 * std::clamp((r.now_s - 5.0) / 0.4, 0.0, 1.0);
    r.target.velocity_enu_m_s = {2.0 * std::cos(yaw), 2.0 * std::sin(yaw), 0.0};
    place += kStep_s * r.target.velocity_enu_m_s;
    r.target.position_enu_m = place;
    r.vehicle.position_enu_m = place - Vec3(2.0, 0.0, -0.3);
    r.sight = {true, true};
    r.clearance_m = 1.0;
    r.estimate.status = TrackStatus::kTracking;
    r.estimate.stamp_s = r.now_s;
    r.beliefs[0].probability = 1.0;
    flight.rows.push_back(r);
  }
  flight.metrics = metrics_of(flight.rows, {});
  return flight;
}

TEST(Outcomes, ATurnAtTheOriginIsAPassAndOneElsewhereIsNot) {
  FlightResult flight = flight_with_a_turn();
  const auto count = [&](EventKind kind) {
    return outcomes_of(flight.metrics, flight.rows, kind, {}).size();
  };
  EXPECT_EQ(count(EventKind::kTurn), 1u);
  EXPECT_EQ(count(EventKind::kPass), 1u);
  for (FlightRow& row : flight.rows) row.target.position_enu_m.y() += 3.0;
  EXPECT_EQ(count(EventKind::kTurn), 1u);
  EXPECT_EQ(count(EventKind::kPass), 0u);
  EXPECT_EQ(count(EventKind::kDeceleration), 0u);
}

TEST(Outcomes, AWalkFailsByOneLongLoss) {
  FlightResult flight = flight_with_a_turn();
  const auto success = [&] {
    flight.metrics = metrics_of(flight.rows, {});
    return outcomes_of(flight.metrics, flight.rows, EventKind::kWalk, {}).at(0).success;
  };
  EXPECT_TRUE(success());
  for (int i = 300; i < 350; ++i) flight.rows[i].sight.unhidden = false;
  EXPECT_TRUE(success());  // 0.5 s
  flight.rows[350].sight.unhidden = false;
  EXPECT_FALSE(success());
}

TEST(Outcomes, ADecelerationFailsOnlyNearerThanAMetre) {
  FlightResult flight = flight_with_a_turn();
  for (FlightRow& row : flight.rows) {  // stops at 5 s within 0.5 s
    const double speed = 2.0 * std::clamp(1.0 - (row.now_s - 5.0) / 0.5, 0.0, 1.0);
    row.target.velocity_enu_m_s = {speed, 0.0, 0.0};
  }
  const auto stop_at = [&](double distance_m) {
    for (FlightRow& row : flight.rows)
      row.vehicle.position_enu_m = row.target.position_enu_m - Vec3(distance_m, 0.0, 0.0);
    flight.metrics = metrics_of(flight.rows, {});
    return outcomes_of(flight.metrics, flight.rows, EventKind::kDeceleration, {});
  };
  ASSERT_EQ(stop_at(1.01).size(), 1u);
  EXPECT_TRUE(stop_at(1.01).front().success);
  EXPECT_FALSE(stop_at(0.99).front().success);
}

TEST(RunRecord, HoldsTheDistanceAroundTheEventAndNothingBeyondTheFlight) {
  const FlightResult flight = flight_with_a_turn();
  const RunRecord r = record_of(flight, csv_of(flight.rows), {}, EventKind::kTurn, {});
  ASSERT_EQ(r.curves.size(), 1u);
  ASSERT_EQ(r.curves[0].size(), 51u);
  EXPECT_NEAR(r.curves[0][10], 2.0, 1e-6);
  EXPECT_EQ(r.log_sha256, sha256_of(csv_of(flight.rows)));
  EXPECT_FALSE(r.failed());
  EXPECT_NEAR(r.mean_speed_m_s, 2.0, 1e-6);
  // 2 m ahead of a vehicle whose yaw is 0.
  EXPECT_NEAR(r.places.x / r.places.count, 2.0, 1e-6);
  EXPECT_NEAR(r.places.y / r.places.count, 0.0, 1e-6);
}

TEST(RelativePlaces, TheEllipseHoldsNinetyPercentOfANormalSample) {
  RelativePlaces places;
  Random random(3);
  for (int i = 0; i < 200000; ++i) places.add({2.0 + 0.3 * random.normal(), 0.2 * random.normal()});
  EXPECT_NEAR(places.ellipse_area_m2(), kPi * 4.605 * 0.3 * 0.2, 0.01);
  double inside = 0.0, all = 0.0;
  for (int iy = 0; iy < RelativePlaces::kCells; ++iy)
    for (int ix = 0; ix < RelativePlaces::kCells; ++ix) {
      const double x = (RelativePlaces::kMinX_m + 0.1 * (ix + 0.5) - 2.0) / 0.3;
      const double y = (RelativePlaces::kMinY_m + 0.1 * (iy + 0.5)) / 0.2;
      const double n = places.cells[iy * RelativePlaces::kCells + ix];
      all += n;
      if (x * x + y * y < 4.605) inside += n;
    }
  EXPECT_NEAR(inside / all, 0.9, 0.02);
}

}  // namespace
}  // namespace foretrack
