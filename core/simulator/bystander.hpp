// SPDX-License-Identifier: Apache-2.0
// People beside the one who is followed: they walk their routes, and are in the way of sight and
// flight.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/simulator/person.hpp"
#include "core/simulator/world.hpp"

namespace foretrack {

inline constexpr double kPersonRadius_m = 0.25;  // of the upright cylinder that a person is

/// Somebody who is not followed: where they walk, and who is rendered.
struct BystanderSpec {
  std::string person = "girl";  // who is rendered
  std::vector<Vec2> route_m;    // to its end, and then stands there
  bool loop = false;            // from the end straight to the start, and round again
  double speed_m_s = 1.4;
  PersonParams walk;
};

/// At the start of the route. for_s: how long a loop has to last. Throws std::invalid_argument for
/// an empty route.
Person make_bystander(const BystanderSpec& spec, double ground_z_m, double for_s);

/// The place on the ground of somebody of this height.
Vec3 foot_enu_m(const PersonState& person, double height_m);

/// What depth cameras see of a person, and what hides others.
Cylinder cylinder_of(const PersonState& person, double height_m);

/// The world with people standing where they are now: `people` replaces those of the last call.
/// world: `shapes` cylinders of the world itself come first.
void place_people(World& world, std::size_t shapes, std::span<const Person> people);

}  // namespace foretrack
