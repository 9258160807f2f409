// SPDX-License-Identifier: Apache-2.0
// Whole flights in which something takes the vehicle: the gate leaves it to whoever has it.
#include <gtest/gtest.h>

#include <algorithm>

#include "services/offline/flight/fly.hpp"

namespace foretrack {
namespace {

constexpr double kIncident_s = 3.0, kEnd_s = 5.5;

FlightResult flight_with(std::vector<Incident> incidents) {
  Scenario scenario;
  scenario.target.route_m = {{-10, 0}, {10, 0}};
  scenario.duration_s = kEnd_s;
  scenario.autopilot.incidents = std::move(incidents);
  return fly(scenario, {});
}

const FlightRow& row_at(const FlightResult& flight, double time_s) {
  return *std::ranges::lower_bound(flight.rows, time_s, {}, &FlightRow::now_s);
}

// It flew before, and afterwards nothing is flown in offboard mode and no setpoint sent.
void expect_given_up(const FlightResult& flight, std::string_view what) {
  EXPECT_TRUE(row_at(flight, kIncident_s - 0.1).autopilot.offboard) << what << ": never flew";
  for (const FlightRow& row : flight.rows) {
    if (row.now_s < kIncident_s + 0.05) continue;
    ASSERT_FALSE(row.autopilot.offboard) << what << ": taken back at " << row.now_s;
    ASSERT_FALSE(row.setpoint) << what << " at " << row.now_s;
  }
}

TEST(Takeover, FlightsThatNobodyDisturbsGoOn) {
  const FlightResult flight = flight_with({});
  EXPECT_TRUE(flight.rows.back().autopilot.offboard);
  EXPECT_EQ(flight.rows.back().mode, "track");
}

TEST(Takeover, APilotsModeAndSticksAreNeverUndone) {
  for (const FlightMode mode : {FlightMode::kPilot, FlightMode::kHold, FlightMode::kReturn,
                                FlightMode::kLand, FlightMode::kOther}) {
    const FlightResult flight = flight_with({{kIncident_s, IncidentKind::kMode, mode}});
    expect_given_up(flight, to_string(mode));
    const FlightMode later = row_at(flight, kIncident_s + 1.0).autopilot.mode;
    EXPECT_TRUE(later == mode || (mode == FlightMode::kReturn && later == FlightMode::kLand));
  }
  expect_given_up(flight_with({{kIncident_s, IncidentKind::kSticks}}), "sticks");
}

TEST(Takeover, AFailsafeIsNotCancelledAndNothingIsFlownWhenItIsOver) {
  for (const auto kind : {IncidentKind::kGeofence, IncidentKind::kBattery, IncidentKind::kLink}) {
    const FlightResult lasting = flight_with({{kIncident_s, kind}});
    expect_given_up(lasting, "failsafe");
    EXPECT_TRUE(lasting.rows.back().autopilot.failsafe);
    EXPECT_FALSE(lasting.rows.back().autopilot.user_took_over);
  }
  const FlightResult brief = flight_with(
      {{kIncident_s, IncidentKind::kGeofence}, {kIncident_s + 0.2, IncidentKind::kWell}});
  for (const FlightRow& row : brief.rows) {
    if (row.now_s < kIncident_s + 0.05) continue;
    ASSERT_FALSE(row.setpoint) << row.now_s;
  }
  EXPECT_FALSE(brief.rows.back().autopilot.offboard);
}

TEST(Takeover, ADisarmedOrTerminatedVehicleIsNotArmedAgain) {
  const FlightResult disarmed = flight_with({{kIncident_s, IncidentKind::kDisarm}});
  expect_given_up(disarmed, "disarm");
  EXPECT_FALSE(disarmed.rows.back().autopilot.armed);
  const FlightResult terminated = flight_with({{kIncident_s, IncidentKind::kTerminate}});
  expect_given_up(terminated, "termination");
  EXPECT_EQ(terminated.rows.back().autopilot.mode, FlightMode::kTermination);
}

TEST(Takeover, AFlightControllerThatRefusesOrKeepsSilentIsAskedOnce) {
  for (const auto kind : {IncidentKind::kDeny, IncidentKind::kIgnore}) {
    const FlightResult flight = flight_with({{0.0, kind}, {4.0, IncidentKind::kObey}});
    for (const FlightRow& row : flight.rows) ASSERT_FALSE(row.autopilot.offboard) << row.now_s;
  }
}

}  // namespace
}  // namespace foretrack
