// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "services/files/config/load_scenario.hpp"
#include "services/offline/flight/write_flight.hpp"

namespace foretrack {
namespace {

Scenario straight_walk() {
  Scenario scenario;
  scenario.target.route_m = {{-10, 0}, {10, 0}};
  scenario.duration_s = 12.0;
  return scenario;
}

// Knows the truth: flies 2 m behind the target and looks at it.
void chase(PilotStep s) {
  const PersonState& target = s.simulator.target;
  const Vec2 behind = target.position_enu_m.head<2>() - 2.0 * direction_of(target.body_yaw_rad);
  Setpoint setpoint;
  setpoint.position_enu_m = {behind.x(), behind.y(), 1.5};
  setpoint.velocity_enu_m_s = target.velocity_enu_m_s;
  setpoint.yaw_rad = target.body_yaw_rad;
  s.command.heartbeat = true;
  s.command.command = {.mode = FlightMode::kOffboard};
  s.command.setpoint = s.row.setpoint = setpoint;
}

TEST(FlyPilot, AnIdealChaserDoesNotLoseTheTarget) {
  const FlightResult flight = fly_pilot(straight_walk(), chase, {});
  EXPECT_EQ(flight.rows.size(), 1200u);
  EXPECT_EQ(flight.metrics.failure_rate, 0.0);
  EXPECT_GT(flight.metrics.band_share, 0.9);
}

TEST(FlyPilot, AnIdlePilotLosesIt) {
  const FlightResult flight = fly_pilot(straight_walk(), [](PilotStep) {}, {});
  EXPECT_GT(flight.metrics.failure_rate, 0.3);
}

TEST(FlyPilot, EndsWhenProgressSaysSo) {
  FlightOptions options;
  options.progress = [](double now_s) { return now_s < 1.0 - 1e-9; };
  EXPECT_EQ(fly_pilot(straight_walk(), chase, {}, options).rows.size(), 100u);
}

TEST(Fly, TheTrackerKeepsAStraightWalkInView) {
  const FlightResult flight = fly(straight_walk(), {});
  EXPECT_LT(flight.metrics.failure_rate, 0.02);
  EXPECT_EQ(flight.metrics.collisions, 0);
  EXPECT_GT(flight.metrics.band_share, 0.8);
  EXPECT_GT(flight.metrics.plan_ms.p50, 0.0);
}

TEST(Fly, ALateCameraDoesNotMakeTheTargetAHiddenOne) {
  Scenario scenario = straight_walk();
  scenario.landmark_camera.delay_s = 0.3;
  const FlightResult flight = fly(scenario, {});
  EXPECT_LT(flight.metrics.failure_rate, 0.02);
  const auto late = std::count_if(flight.rows.begin() + 200, flight.rows.end(), [](const auto& r) {
    return r.estimate.status != TrackStatus::kTracking;
  });
  EXPECT_EQ(late, 0);
}

TEST(Fly, TheSameSeedGivesTheSameLogAndAnotherSeedAnother) {
  ScenarioOverrides o;
  o.duration_s = 8.0;
  const auto hash = [&] {
    return sha256_of(csv_of(fly(load_scenario("street_blocks", o), {}).rows));
  };
  const std::string first = hash();
  EXPECT_EQ(first, hash());
  o.seed = 2;
  EXPECT_NE(first, hash());
}

TEST(WriteFlight, WritesTheFilesAndTheirHash) {
  const auto folder = std::filesystem::temp_directory_path() / "foretrack_write_flight";
  std::filesystem::remove_all(folder);
  Scenario scenario = straight_walk();
  scenario.duration_s = 2.0;
  const FlightResult flight = fly_pilot(scenario, chase, {});
  const std::string hash = write_flight(flight, {}, folder);
  EXPECT_EQ(hash, sha256_of(csv_of(flight.rows)));
  for (const char* name : {"log.csv", "log.sha256", "metrics.json", "scenario.json"})
    EXPECT_GT(std::filesystem::file_size(folder / name), 50u) << name;
  EXPECT_THROW(write_flight(flight, {}, folder / "log.csv" / "inner"), std::runtime_error);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace foretrack
