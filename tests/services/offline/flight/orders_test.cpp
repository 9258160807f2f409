// SPDX-License-Identifier: Apache-2.0
// Operators' orders in flight: framing, and whom to follow.
#include <gtest/gtest.h>

#include <algorithm>

#include "services/offline/flight/fly.hpp"

namespace foretrack {
namespace {

/// What was commanded and what came of it.
struct Flown {
  FlightResult flight;
  double speed_m_s = 0.0, acceleration_m_s2 = 0.0, step_m = 0.0;  // the greatest that was commanded
  double least_m = 1e9;                                           // of the person, horizontally
};

Flown fly_with(const Scenario& scenario, const TrackerParams& params = {}) {
  Flown out;
  out.flight = fly(scenario, params);
  const Setpoint* before = nullptr;
  for (const FlightRow& row : out.flight.rows) {
    out.least_m = std::min(out.least_m, row.distance_m());
    if (!row.setpoint || row.setpoint->position_enu_m.hasNaN()) continue;
    const Setpoint& s = *row.setpoint;
    out.speed_m_s = std::max(out.speed_m_s, s.velocity_enu_m_s.norm());
    if (!s.acceleration_enu_m_s2.hasNaN())
      out.acceleration_m_s2 = std::max(out.acceleration_m_s2, s.acceleration_enu_m_s2.norm());
    if (before)
      out.step_m = std::max(out.step_m, (s.position_enu_m - before->position_enu_m).norm());
    before = &s;
  }
  return out;
}

void expect_within_limits(const Flown& flown) {
  const FlightLimits limits = TrackerParams{}.planning.limits;
  EXPECT_LE(flown.speed_m_s, limits.speed_max_m_s + 1e-3);
  EXPECT_LE(flown.acceleration_m_s2, limits.acceleration_max_m_s2 + 1e-2);
  EXPECT_LE(flown.step_m, 0.01 * limits.speed_max_m_s + 0.02) << "no jump";
}

Scenario long_walk(std::vector<OperatorOrder> orders, double duration_s) {
  Scenario scenario;
  scenario.world.min_m = {-40, -20, 0};
  scenario.world.max_m = {40, 20, 10};
  scenario.target.route_m = {{-30, 0}, {30, 0}};
  scenario.target.speed_m_s = 1.0;
  scenario.duration_s = duration_s;
  scenario.orders = std::move(orders);
  return scenario;
}

Vec3 offset(const FlightRow& row) {
  return row.vehicle.position_enu_m - row.target.position_enu_m;
}

TEST(Orders, DistanceAndHeightAreComeToWithinTheLimits) {
  const Flown flown = fly_with(long_walk({{6.0, {}, {.distance_m = 4.5}},
                                          {16.0, {}, {.distance_m = 4.5, .height_m = 1.5}},
                                          {24.0, {}, {.distance_m = 1.5, .height_m = -0.2}}},
                                         40.0));
  expect_within_limits(flown);
  const auto& rows = flown.flight.rows;
  EXPECT_NEAR(rows[1550].distance_m(), 4.5, 0.5);
  EXPECT_NEAR(offset(rows[2390]).z(), 1.5, 0.3);
  EXPECT_LT(rows.back().distance_m(), 2.6);
  EXPECT_GT(flown.least_m, 1.5) << "never nearer than is safe";
  EXPECT_EQ(flown.flight.metrics.failure_rate, 0.0);
}

TEST(Orders, TheVehicleGoesToEachSideWithinTheLimits) {
  for (const double bearing_rad : {0.0, 0.5 * kPi, -0.5 * kPi, kPi}) {
    const Flown flown = fly_with(long_walk({{5.0, {}, {.bearing_rad = bearing_rad}}}, 25.0));
    expect_within_limits(flown);
    const double is_rad = yaw_of(offset(flown.flight.rows.back()).head<2>());  // they walk along x
    EXPECT_LT(std::abs(wrap_angle(is_rad - bearing_rad)), 0.4) << bearing_rad;
    EXPECT_GT(flown.least_m, 1.4);
  }
}

TEST(Orders, TheVehicleCirclesWithinTheLimits) {
  const Flown flown = fly_with(long_walk({{5.0, {}, {.circling_rad_s = 0.3}}}, 30.0));
  expect_within_limits(flown);
  const auto bearing = [&](std::size_t row) {
    return yaw_of(offset(flown.flight.rows[row]).head<2>());
  };
  EXPECT_NEAR(wrap_angle(bearing(2500) - bearing(1500)), 3.0, 0.5);
}

TEST(Orders, AFramingThatIsNotSafeChangesNothing) {
  const Flown flown = fly_with(long_walk({{5.0, {}, {.distance_m = 0.5}}}, 15.0));
  const Flown plain = fly_with(long_walk({}, 15.0));
  EXPECT_EQ(flown.flight.rows.back().vehicle.position_enu_m,
            plain.flight.rows.back().vehicle.position_enu_m);
}

// Bob walks beside the person, 3 m ahead and to their left; his number is 2.
Scenario walk_of_two(std::vector<OperatorOrder> orders, double duration_s) {
  Scenario scenario = long_walk(std::move(orders), duration_s);
  scenario.people_all_round = true;
  BystanderSpec bob;
  bob.route_m = {{-27, 3}, {30, 3}};
  bob.speed_m_s = 1.0;
  scenario.bystanders = {bob};
  return scenario;
}

double least_gap_m(const FlightResult& flight) {
  double least_m = 1e9;
  for (const FlightRow& row : flight.rows)
    for (const PersonTruth& who : {row.followed(), row.bystanders[0]})
      least_m = std::min(
          least_m, gap_m(row.vehicle.position_enu_m, 0.25, who.foot_enu_m, 0.25, who.height_m));
  return least_m;
}

TEST(Orders, AnotherPersonIsFollowedWithoutAJumpAndBothAreKeptClearOf) {
  const Flown flown = fly_with(walk_of_two({{8.0, 2, {}}}, 20.0));
  expect_within_limits(flown);
  EXPECT_GT(least_gap_m(flown.flight), 0.5);
  const FlightRow& end = flown.flight.rows.back();
  EXPECT_LT(distance_xy(end.vehicle.position_enu_m, end.bystanders[0].foot_enu_m), 3.0);
  EXPECT_LT(distance_xy(end.estimate.position_enu_m, end.bystanders[0].foot_enu_m), 0.5);
}

TEST(Orders, WhoWasFollowedBeforeIsFollowedAgainWhileTheyAreThere) {
  const Flown flown = fly_with(walk_of_two({{8.0, 2, {}}, {9.0, 1, {}}}, 16.0));
  expect_within_limits(flown);
  EXPECT_GT(least_gap_m(flown.flight), 0.5);
  const FlightRow& between = flown.flight.rows[890];
  EXPECT_LT(distance_xy(between.estimate.position_enu_m, between.bystanders[0].foot_enu_m), 0.7);
  EXPECT_LT(flown.flight.rows.back().distance_m(), 2.6);
  EXPECT_LT(distance_xy(flown.flight.rows.back().estimate.position_enu_m,
                        flown.flight.rows.back().target.position_enu_m),
            0.3);
}

TEST(Orders, NobodyIsFollowedTheVehicleStands) {
  const Flown flown = fly_with(long_walk({{8.0, 0, {}}}, 16.0));
  expect_within_limits(flown);
  EXPECT_LT(flown.flight.rows.back().vehicle.velocity_enu_m_s.norm(), 0.1);
  EXPECT_GT(flown.flight.rows.back().distance_m(), 4.0) << "they have gone on";
}

}  // namespace
}  // namespace foretrack
