// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/simulate.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

Scenario box_scenario() {
  Scenario scenario;
  scenario.generator = {WorldKind::kBoxes, 100, 5};
  scenario.seed = 5;
  scenario.duration_s = 30.0;
  return scenario;
}

TEST(Simulate, TheSameSeedGivesTheSameStepsAndAnotherSeedOthers) {
  Scenario scenario = box_scenario();
  scenario.wind.gust_m_s = 0.5;
  scenario.map = MapSource::kDepth;
  SimulatorState a = make_simulator(scenario), b = make_simulator(scenario);
  scenario.seed = 6;
  SimulatorState c = make_simulator(scenario);
  bool differs = false;
  for (int i = 0; i < 300; ++i) {
    const auto &x = simulate(a, {}, 0.01), &y = simulate(b, {}, 0.01), &z = simulate(c, {}, 0.01);
    ASSERT_EQ(x.vehicle.position_enu_m, y.vehicle.position_enu_m);
    ASSERT_EQ(x.target.position_enu_m, y.target.position_enu_m);
    ASSERT_EQ(x.observation.has_value(), y.observation.has_value());
    if (x.observation) {
      ASSERT_EQ(x.observation->landmarks[5].image_px, y.observation->landmarks[5].image_px);
    }
    ASSERT_EQ(x.depth != nullptr, y.depth != nullptr);
    if (x.depth) {
      ASSERT_EQ(x.depth->depth_m, y.depth->depth_m);
    }
    differs |= x.target.position_enu_m != z.target.position_enu_m;
  }
  EXPECT_TRUE(differs);
}

TEST(Simulate, DepthImagesComeOnlyWhereTheyAreWanted) {
  Scenario scenario = box_scenario();
  const auto count = [&] {
    SimulatorState state = make_simulator(scenario);
    int images = 0;
    for (int i = 0; i < 200; ++i) images += simulate(state, {}, 0.01).depth != nullptr;
    return images;
  };
  EXPECT_EQ(count(), 0);
  scenario.map = MapSource::kDepth;
  EXPECT_NEAR(count(), 30, 1);
  scenario.map = MapSource::kKnown;
  scenario.depth_images = true;
  EXPECT_NEAR(count(), 30, 1);
}

TEST(Simulate, StartsTwoMetresBehindTheTargetFacingItOrInTheNearestFreePlace) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scenario scenario = box_scenario();
    scenario.seed = scenario.generator.seed = seed;
    const SimulatorState state = make_simulator(scenario);
    const auto& out = state.output;
    const Vec2 to_target = (out.target.position_enu_m - out.vehicle.position_enu_m).head<2>();
    EXPECT_GE(clearance_m(state.world, out.vehicle.position_enu_m), 0.5);
    EXPECT_TRUE(line_of_sight(state.world, out.vehicle.position_enu_m, out.target.position_enu_m));
    EXPECT_NEAR(to_target.norm(), 2.0, 1.01);
    EXPECT_NEAR(wrap_angle(yaw_of(to_target) - out.vehicle.yaw_rad()), 0.0, 1e-9);
  }
  Scenario open;
  open.target.route_m = {{0, 0}, {5, 0}};
  EXPECT_LT((make_simulator(open).output.vehicle.position_enu_m - Vec3(-2, 0, 1.5)).norm(), 1e-9);
}

TEST(Simulate, HoversUntilItIsCommandedThenFliesSetpoints) {
  Scenario scenario;
  scenario.target.route_m = {{0, 0}, {5, 0}};
  SimulatorState state = make_simulator(scenario);
  const Vec3 start = state.output.vehicle.position_enu_m;
  for (int i = 0; i < 100; ++i) simulate(state, {}, 0.01);
  EXPECT_LT((state.output.vehicle.position_enu_m - start).norm(), 1e-3);
  AutopilotInput input;
  input.heartbeat = true;
  input.command = {.mode = FlightMode::kOffboard};
  input.setpoint = Setpoint{.position_enu_m = start + Vec3(0, 1, 0.5)};
  for (int i = 0; i < 800; ++i) simulate(state, input, 0.01);
  EXPECT_TRUE(state.output.autopilot.offboard);
  EXPECT_LT((state.output.vehicle.position_enu_m - start - Vec3(0, 1, 0.5)).norm(), 0.05);
}

TEST(Simulate, PeopleWhoWaitDoLaterWhatTheyWouldHaveDone) {
  Scenario scenario = box_scenario();
  scenario.target.person.stops = {{.at_s = 2.5, .for_s = 0.5}};
  SimulatorState punctual = make_simulator(scenario), late = make_simulator(scenario);
  const Vec3 start = late.person.state.position_enu_m;
  late.people_wait = true;
  for (int i = 0; i < 400; ++i) simulate(late, {}, 0.01);
  EXPECT_EQ(late.person.state.position_enu_m, start);
  late.people_wait = false;
  for (int i = 0; i < 500; ++i) {
    simulate(punctual, {}, 0.01);
    simulate(late, {}, 0.01);
    // Sums of steps of 10 ms may put a start one step off.
    ASSERT_LT((late.person.state.position_enu_m - punctual.person.state.position_enu_m).norm(),
              0.03);
  }
  EXPECT_GT((late.person.state.position_enu_m - start).norm(), 1.0);
}

TEST(Simulate, RefusesStartsInsideObstaclesAndOutsideTheBounds) {
  Scenario scenario;
  scenario.target.route_m = {{0, 0}, {5, 0}};
  scenario.world.boxes.push_back({{2, 2, 0}, {4, 4, 4}});
  scenario.vehicle_enu_m = Vec3(3, 3, 1);
  EXPECT_THROW(make_simulator(scenario), std::invalid_argument);
  scenario.vehicle_enu_m = Vec3(30, 3, 1);
  EXPECT_THROW(make_simulator(scenario), std::invalid_argument);
  scenario.vehicle_enu_m.reset();
  scenario.target.route_m = {{3, 3}, {10, 0}};
  EXPECT_THROW(make_simulator(scenario), std::invalid_argument);
}

TEST(Simulate, EveryPartShowsTheSameInstant) {
  SimulatorState state = make_simulator(box_scenario());
  for (int i = 0; i < 500; ++i) {
    const auto& out = simulate(state, {}, 0.01);
    ASSERT_EQ(out.now_s, out.vehicle.stamp_s);
    ASSERT_EQ(out.now_s, out.target.stamp_s);
    ASSERT_EQ(out.now_s, out.autopilot.stamp_s);
  }
}

}  // namespace
}  // namespace foretrack
