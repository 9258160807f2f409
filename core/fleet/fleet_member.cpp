// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_member.hpp"

namespace foretrack {

Vec3 FleetPlan::position(double time_s) const {
  double t = std::max(time_s - start_s, 0.0);
  for (int i = 0; i < count; ++i) {
    if (t <= pieces[i].duration_s) return pieces[i].position(t);
    t -= pieces[i].duration_s;
  }
  return pieces[count - 1].position(pieces[count - 1].duration_s);
}

const FleetPerson* FleetMember::followed() const {
  if (follows == 0) return nullptr;
  for (const FleetPerson& person : all_persons())
    if (person.id == follows) return &person;
  return nullptr;
}

}  // namespace foretrack
