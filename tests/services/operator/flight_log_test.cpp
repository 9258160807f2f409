// SPDX-License-Identifier: Apache-2.0
#include "services/operator/flight_log.hpp"

#include <gtest/gtest.h>

#include "services/convert/safety.hpp"
#include "services/convert/vehicle.hpp"
#include "services/operator/summary.hpp"

namespace foretrack {
namespace {

// The vehicle flies 2 m behind a person who walks along x at 1 m/s.
struct Flight {
  explicit Flight(const Scenario& scenario = {}) : log(scenario) { log.attach(hooks); }

  void truth(double now_s) {
    nav_msgs::msg::Odometry message;
    VehicleState state;
    state.stamp_s = now_s;
    state.position_enu_m = Vec3(now_s, 0.0, 1.3);
    state.velocity_enu_m_s = Vec3(1.0, 0.0, 0.0);
    to_idl(state, message);
    hooks.target_truth(message);
    state.position_enu_m.x() -= 2.0;
    to_idl(state, message);
    hooks.vehicle_truth(message);
  }
  void safety(double stamp_s, double caused_by_s) {
    GateReport report;
    report.stamp_s = stamp_s;
    report.caused_by_s = caused_by_s;
    report.result.mode = SafetyMode::kTrack;
    report.result.setpoint = Setpoint{.stamp_s = stamp_s};
    foretrack_msgs::msg::SafetyState message;
    to_idl(report, message);
    hooks.safety(message);
  }

  FlightLog log;
  Hooks hooks;
};

TEST(FlightLog, MakesRowsAtEqualStepsFromUnevenSamples) {
  Flight flight;
  double now_s = 100.0;
  for (int i = 0; i < 200; ++i) flight.truth(now_s += i % 3 == 0 ? 0.013 : 0.031);
  const auto& rows = flight.log.rows();
  ASSERT_GT(rows.size(), 200u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].now_s, FlightLog::kStep_s * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(rows[i].target.position_enu_m.x() - rows[0].target.position_enu_m.x(),
                rows[i].now_s, 1e-6);
    EXPECT_NEAR(rows[i].distance_m(), 2.0, 1e-6);
    EXPECT_TRUE(rows[i].sight.visible());
  }
  EXPECT_NEAR(flight.log.path_length_m(), rows.back().now_s, 1e-6);
}

TEST(FlightLog, SeesThatAWallHidesThePerson) {
  Scenario scenario;
  scenario.world.boxes = {{.min_m = Vec3(-1.2, -2.0, 0.0), .max_m = Vec3(-1.0, 2.0, 3.0)}};
  Flight flight(scenario);
  flight.truth(0.0);
  flight.truth(0.02);
  ASSERT_FALSE(flight.log.rows().empty());
  EXPECT_FALSE(flight.log.rows()[0].sight.visible());
  EXPECT_NEAR(flight.log.rows()[0].clearance_m, 0.8, 1e-3);
}

TEST(FlightLog, TakesTheLatencyOfEachImageOnce) {
  Flight flight;
  flight.safety(10.08, 10.00);
  flight.safety(10.09, 10.00);
  flight.safety(10.15, 10.05);
  ASSERT_EQ(flight.log.latency_ms().size(), 2u);
  EXPECT_NEAR(flight.log.latency_ms()[0], 80.0, 0.01);
  EXPECT_NEAR(flight.log.latency_ms()[1], 100.0, 0.01);
}

TEST(FlightLog, TakesTheWallTimeFromARenderedImageToTheSetpointThatItCaused) {
  double wall_s = 500.0;
  FlightLog log(Scenario{}, [&] { return wall_s; });
  Hooks hooks;
  log.attach(hooks);
  const auto caused_by = [&](double stamp_s) {
    GateReport report;
    report.stamp_s = stamp_s + 0.04;
    report.caused_by_s = stamp_s;
    report.result.setpoint = Setpoint{.stamp_s = report.stamp_s};
    foretrack_msgs::msg::SafetyState message;
    to_idl(report, message);
    hooks.safety(message);
  };
  for (const double stamp_s : {10.00, 10.03, 10.07}) {
    hooks.color_image(stamp_s);
    wall_s += 0.1;  // the flight's clock is slowed
  }
  caused_by(10.03);
  wall_s += 0.05;
  caused_by(10.05);  // a stamp that was coasted to
  caused_by(10.07);
  ASSERT_EQ(log.wall_latency_ms().size(), 2u);
  EXPECT_NEAR(log.wall_latency_ms()[0], 200.0, 1e-6);
  EXPECT_NEAR(log.wall_latency_ms()[1], 150.0, 1e-6);
  EXPECT_EQ(log.latency_ms().size(), 3u);
}

TEST(Summary, SaysThatAVehicleWhichStoodDidNotFly) {
  const FlightSummary nothing = summarize(FlightLog(Scenario{}), MetricParams{});
  EXPECT_FALSE(nothing.happened());
  EXPECT_FALSE(nothing.good());
  Flight flight;
  for (int i = 0; i < 100; ++i) {
    flight.truth(0.02 * i);
    flight.hooks.plan({});
  }
  FlightSummary flown = summarize(flight.log, MetricParams{});
  EXPECT_TRUE(flown.good());
  EXPECT_NEAR(flown.metrics.mean_distance_m, 2.0, 1e-6);
  flown.metrics.collisions = 1;
  EXPECT_FALSE(flown.good());
}

}  // namespace
}  // namespace foretrack
