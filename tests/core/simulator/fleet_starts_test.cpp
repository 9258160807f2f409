// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/fleet_starts.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace foretrack {
namespace {

struct Flight {
  explicit Flight(int vehicles, double room_m = 10.0) {
    scenario.world.min_m = {-room_m, -room_m, 0};
    scenario.world.max_m = {room_m, room_m, 5};
    scenario.target.route_m = {{0, 0}, {5, 0}};
    for (int i = 0; i < vehicles; ++i)
      scenario.vehicles.emplace_back().name = "uav" + std::to_string(i + 1);
    world = world_of(scenario);
    person = make_person(scenario.target.person, walk_of(scenario, world), 0.0);
  }
  std::vector<Vec3> starts() const { return fleet_starts(scenario, world, *person); }

  Scenario scenario;
  World world;
  std::optional<Person> person;
};

TEST(FleetStarts, EachHasRoomAndSeesThePerson) {
  const Flight flight(6);
  const std::vector<Vec3> starts = flight.starts();
  ASSERT_EQ(starts.size(), 6U);
  EXPECT_NEAR(distance_xy(starts[0], flight.person->state.position_enu_m), 2.0, 1e-9);
  for (std::size_t i = 0; i < starts.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(distance_xy(starts[i], starts[k]), 1.8);
}

TEST(FleetStarts, AGivenPlaceIsKeptAndKeptFree) {
  Flight flight(2);
  flight.scenario.vehicles[1].position_enu_m = Vec3(-2.0, 0.0, 1.5);  // behind the person
  const std::vector<Vec3> starts = flight.starts();
  EXPECT_EQ(starts[1], Vec3(-2.0, 0.0, 1.5));
  EXPECT_GE(distance_xy(starts[0], starts[1]), 1.8);
}

TEST(FleetStarts, WhereThereIsNoRoomTheVehicleIsNamed) {
  Flight flight(14, 3.0);
  flight.scenario.target.route_m = {{0, 0}, {1, 0}};
  try {
    flight.starts();
    FAIL() << "found room for fourteen";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("uav"), std::string::npos);
  }
}

TEST(ScenarioOf, OneVehicleFliesItAloneWithNoiseOfItsOwn) {
  const Flight flight(2);
  const Scenario one = scenario_of(flight.scenario, 1, {0, 2, 1.5}, *flight.person);
  EXPECT_TRUE(one.vehicles.empty());
  EXPECT_EQ(one.vehicle_number, 1);
  EXPECT_NEAR(one.vehicle_yaw_rad, -0.5 * kPi, 1e-9) << "looks at the person";
}

}  // namespace
}  // namespace foretrack
