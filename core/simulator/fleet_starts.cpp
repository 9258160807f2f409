// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/fleet_starts.hpp"

#include <algorithm>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr double kStartAltitude_m = 1.5, kStartRoom_m = 0.5;
constexpr double kStartsApart_m = 1.8;  // of two vehicles' centres

bool is_free(const World& world, const Vec3& place, const PersonState& person,
             const std::vector<Vec3>& taken) {
  return world.contains(place) && clearance_m(world, place) >= kStartRoom_m &&
         line_of_sight(world, place, person.position_enu_m) &&
         std::none_of(taken.begin(), taken.end(), [&](const Vec3& other) {
           return distance_xy(place, other) < kStartsApart_m;
         });
}

Vec3 free_place(const World& world, const Person& who, const std::vector<Vec3>& taken,
                const std::string& name) {
  const PersonState& person = who.state;
  for (const double distance_m : {2.0, 3.5, 3.0, 2.5, 4.5, 5.5, 6.0})
    for (int k = 0; k < 24; ++k) {
      const int steps = (k + 1) / 2;  // to either side in turn
      const double angle = who.course_rad + kPi + (k % 2 ? 1 : -1) * steps * kPi / 12.0;
      const Vec2 p = person.position_enu_m.head<2>() + distance_m * direction_of(angle);
      const Vec3 place(p.x(), p.y(), world.min_m.z() + kStartAltitude_m);
      if (is_free(world, place, person, taken)) return place;
    }
  throw std::invalid_argument("scenario: no free place near the target for vehicle " + name);
}

}  // namespace

std::vector<Vec3> fleet_starts(const Scenario& scenario, const World& world, const Person& person) {
  std::vector<Vec3> taken;
  for (const FleetVehicle& vehicle : scenario.vehicles)
    if (vehicle.position_enu_m) taken.push_back(*vehicle.position_enu_m);
  std::vector<Vec3> starts;
  for (const FleetVehicle& vehicle : scenario.vehicles) {
    if (vehicle.position_enu_m) {
      starts.push_back(*vehicle.position_enu_m);
      continue;
    }
    starts.push_back(free_place(world, person, taken, vehicle.name));
    taken.push_back(starts.back());
  }
  return starts;
}

Scenario scenario_of(const Scenario& scenario, std::size_t vehicle, const Vec3& start_enu_m,
                     const Person& person) {
  Scenario one = scenario;
  const FleetVehicle& spec = scenario.vehicles[vehicle];
  const Vec2 towards = (person.state.position_enu_m - start_enu_m).head<2>();
  one.vehicle_enu_m = start_enu_m;
  one.vehicle_yaw_rad = spec.position_enu_m ? spec.yaw_rad : yaw_of(towards);
  one.vehicle_number = static_cast<int>(vehicle);
  one.vehicles.clear();
  return one;
}

}  // namespace foretrack
