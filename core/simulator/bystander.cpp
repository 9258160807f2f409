// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/bystander.hpp"

namespace foretrack {
namespace {

// Round and round until the walk is long enough.
std::vector<Vec2> laps_of(const std::vector<Vec2>& route_m, double length_m) {
  std::vector<Vec2> laps = route_m;
  double walked_m = 0.0;
  while (route_m.size() > 1 && walked_m < length_m) {
    const std::size_t from = laps.size() - 1;
    laps.insert(laps.end(), route_m.begin(), route_m.end());
    for (std::size_t i = from; i + 1 < laps.size(); ++i) walked_m += (laps[i + 1] - laps[i]).norm();
    if (walked_m <= 0.0) return route_m;  // all its points are the same one
  }
  return laps;
}

}  // namespace

Person make_bystander(const BystanderSpec& spec, double ground_z_m, double for_s) {
  const auto route_m = spec.loop ? laps_of(spec.route_m, spec.speed_m_s * for_s) : spec.route_m;
  Walk walk = walk_along(
      route_m, {.speed_m_s = spec.speed_m_s, .acceleration_m_s2 = spec.walk.acceleration_m_s2});
  return make_person(spec.walk, std::move(walk), ground_z_m);
}

Vec3 foot_enu_m(const PersonState& person, double height_m) {
  return person.position_enu_m - torso_height_m(height_m) * Vec3::UnitZ();
}

Cylinder cylinder_of(const PersonState& person, double height_m) {
  const Vec3 foot = foot_enu_m(person, height_m);
  return {foot.head<2>(), kPersonRadius_m, height_m, foot.z()};
}

void place_people(World& world, std::size_t shapes, std::span<const Person> people) {
  world.cylinders.resize(shapes);
  for (const Person& person : people)
    world.cylinders.push_back(cylinder_of(person.state, person.params.height_m));
}

}  // namespace foretrack
