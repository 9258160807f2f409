// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/place_scenario.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

Scenario corridor() {
  Scenario s;
  s.world.min_m = {-6, -4, 0};
  s.world.max_m = {14, 4, 4};
  s.world.boxes = {{{-6, 2, 0}, {14, 3, 3}}, {{-6, -3, 0}, {14, -2, 3}}};
  s.world.cylinders = {{.center_m = {8.0, 0.5}, .radius_m = 0.4}};
  s.target.route_m = {{0, 0}, {6, 0}, {6, 1}};
  s.target.speed_m_s = 1.5;
  s.vehicle_enu_m = Vec3(-2, 0, 1.5);
  return s;
}

VehicleState at(const Vec3& place, double yaw_rad, double stamp_s = 0.0) {
  return {.stamp_s = stamp_s,
          .position_enu_m = place,
          .q_world_body = Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()))};
}

TEST(PlaceScenario, ThePersonStandsStraightAheadOfTheVehicleWhereverItIsHeaded) {
  for (const double yaw_rad : {0.0, 0.5, 1.5708, 2.5, 3.1, -1.0, -2.2}) {
    auto state = make_simulator(corridor());
    const Vec3 place(12.0, -7.0, 0.1);
    place_scenario(state, at(place, yaw_rad));
    const Vec2 ahead = (state.person.state.position_enu_m - place).head<2>();
    EXPECT_NEAR(yaw_of(ahead), yaw_rad, 1e-6);
    EXPECT_GE(ahead.norm(), 1.4);
    EXPECT_LE(ahead.norm(), 3.1);
  }
}

// What surrounds the person is as it was, along the whole walk.
TEST(PlaceScenario, TurnsWallsAndWalkTogether) {
  const auto before = make_simulator(corridor());
  for (const double yaw_rad : {0.0, 1.5708, 3.1416, -1.5708}) {
    auto after = make_simulator(corridor());
    place_scenario(after, at({3, 4, 0}, yaw_rad));
    EXPECT_DOUBLE_EQ(after.world.min_m.z(), 0.0);
    for (double t = 0.0; t < before.person.walk.duration_s(); t += 0.2) {
      const Vec2 was = before.person.walk.at(t).position_m, is = after.person.walk.at(t).position_m;
      EXPECT_NEAR(ground_clearance_m(after.world, is), ground_clearance_m(before.world, was), 1e-9);
      EXPECT_NEAR(after.person.walk.at(t).velocity_m_s.norm(),
                  before.person.walk.at(t).velocity_m_s.norm(), 1e-9);
    }
  }
}

TEST(PlaceScenario, SaysWhenNobodyCanBeAhead) {
  Scenario s = corridor();
  s.world.boxes.push_back({{-6, -2, 0}, {-0.5, 2, 3}});
  s.world.boxes.push_back({{0.5, -2, 0}, {14, 2, 3}});
  s.world.boxes.push_back({{-6, 0.5, 0}, {14, 2, 3}});
  s.world.boxes.push_back({{-6, -2, 0}, {14, -0.5, 3}});
  s.target.route_m = {{0, 0}};
  s.vehicle_enu_m = Vec3(0, 0.3, 1.5);
  auto state = make_simulator(s);
  EXPECT_THROW(place_scenario(state, at(Vec3::Zero(), 0.3)), std::invalid_argument);
}

TEST(BeginAt, PeopleAndCamerasTakeTheirTimeFromThenOn) {
  auto state = make_simulator(corridor());
  const double start_s = 1.7e9;
  begin_at(state, start_s);
  VehicleState vehicle = at({-2, 0, 1.5}, 0.0);
  int seen = 0;
  Vec3 place = state.person.state.position_enu_m;
  for (int i = 1; i <= 100; ++i) {
    vehicle.stamp_s = start_s + 0.01 * i;
    const auto& out = simulate_around(state, vehicle);
    EXPECT_DOUBLE_EQ(out.now_s, vehicle.stamp_s);
    if (out.observation) {
      ++seen;
      EXPECT_NEAR(out.observation->stamp_s, vehicle.stamp_s, 0.1);
    }
  }
  EXPECT_NEAR(seen, state.scenario.landmark_camera.rate_hz, 4.0) << "in a second, and no burst";
  EXPECT_LT((state.person.state.position_enu_m - place).norm(), 0.01) << "they set off at 1.5 s";
  for (int i = 101; i <= 400; ++i) {
    vehicle.stamp_s = start_s + 0.01 * i;
    simulate_around(state, vehicle);
  }
  EXPECT_GT((state.person.state.position_enu_m - place).norm(), 2.0);
  EXPECT_THROW(simulate_around(state, vehicle), std::invalid_argument) << "the same stamp again";
}

}  // namespace
}  // namespace foretrack
