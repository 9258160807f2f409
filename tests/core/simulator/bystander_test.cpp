// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/bystander.hpp"

#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"

namespace foretrack {
namespace {

BystanderSpec bystander_on(std::vector<Vec2> route_m) {
  BystanderSpec spec;
  spec.route_m = std::move(route_m);
  spec.speed_m_s = 1.0;
  spec.walk.start_s = 0.0;
  return spec;
}

Vec2 place_after(const BystanderSpec& spec, double for_s) {
  Person person = make_bystander(spec, 0.0, for_s);
  for (int i = 0; i < std::lround(for_s / 0.01); ++i) advance(person, 0.01);
  return person.state.position_enu_m.head<2>();
}

TEST(Bystander, WalksToTheEndOfTheRouteAndStandsThere) {
  const BystanderSpec spec = bystander_on({{0, 0}, {3, 0}});
  EXPECT_NEAR(place_after(spec, 2.0).x(), 2.0, 0.25);
  EXPECT_NEAR((place_after(spec, 10.0) - Vec2(3, 0)).norm(), 0.0, 1e-6);
}

TEST(Bystander, GoesRoundAgainWhereTheRouteIsALoop) {
  BystanderSpec spec = bystander_on({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  spec.loop = true;
  Person person = make_bystander(spec, 0.0, 30.0);
  double nearest_late_m = 1e9;
  for (int i = 0; i < 3000; ++i) {
    advance(person, 0.01);
    const double from_start_m = person.state.position_enu_m.head<2>().norm();
    if (i > 1500) nearest_late_m = std::min(nearest_late_m, from_start_m);
  }
  EXPECT_LT(nearest_late_m, 0.5);
  EXPECT_GT(person.state.velocity_enu_m_s.norm(), 0.3);
}

TEST(Bystander, StopsWhenToldTo) {
  BystanderSpec spec = bystander_on({{0, 0}, {20, 0}});
  spec.walk.stops = {{2.0, 3.0}};
  EXPECT_NEAR((place_after(spec, 4.8) - place_after(spec, 3.0)).norm(), 0.0, 1e-6);
  EXPECT_GT(place_after(spec, 7.0).x(), place_after(spec, 4.8).x() + 1.0);
}

// The vehicle hovers 4 m behind the person, and somebody stands between them.
Scenario one_between() {
  Scenario scenario;
  scenario.target.route_m = {{0, 0}, {0.5, 0}};
  scenario.vehicle_enu_m = Vec3(-4, 0, 1.2);
  scenario.bystanders = {bystander_on({{-2, 0}})};
  return scenario;
}

TEST(Bystander, HidesTheFollowedPersonFromTheLandmarkCamera) {
  const auto seen = [](const Scenario& scenario) {
    SimulatorState state = make_simulator(scenario);
    int count = 0;
    for (int i = 0; i < 50; ++i) count += simulate(state, {}, 0.01).observation.has_value();
    return count;
  };
  Scenario scenario = one_between();
  EXPECT_EQ(seen(scenario), 0);
  scenario.bystanders[0].route_m = {{-2, 2}};
  EXPECT_GT(seen(scenario), 10);
}

TEST(Bystander, StandsInDepthImagesAndNotOnTheKnownMap) {
  Scenario scenario = one_between();
  scenario.depth_images = true;
  scenario.depth_camera.noise_m = 0.0;
  SimulatorState state = make_simulator(scenario);
  const SimulatorOutput& out = simulate(state, {}, 0.01);
  ASSERT_NE(out.depth, nullptr);
  const CameraModel& c = out.depth->camera;
  const float ahead_m =
      out.depth->depth_m[static_cast<std::size_t>(c.height_px / 2) * c.width_px + c.width_px / 2];
  EXPECT_NEAR(ahead_m, 4.0 - 2.0 - kPersonRadius_m, 0.15);
  EXPECT_TRUE(state.world.cylinders.empty());
  const GridMap map = known_map(state.world, 0.15);
  EXPECT_EQ(map.cell_at({-2.0, 0.0, 1.0}), Cell::kFree);
}

TEST(Bystander, IsTruthAndSightingInTheOutputWhereThereIsOneAndNothingElsewhere) {
  Scenario scenario = one_between();
  SimulatorState state = make_simulator(scenario);
  int looks = 0;
  for (int i = 0; i < 100; ++i) {
    const SimulatorOutput& out = simulate(state, {}, 0.01);
    ASSERT_EQ(out.bystanders.size(), 1u);
    looks += out.sightings.has_value();
  }
  EXPECT_NEAR(looks, 10, 1);
  scenario.bystanders.clear();
  SimulatorState alone = make_simulator(scenario);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(simulate(alone, {}, 0.01).sightings);
}

}  // namespace
}  // namespace foretrack
