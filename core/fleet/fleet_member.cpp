// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_member.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {

SeatBid as_told(const SeatBid& bid) {
  SeatBid told;
  if (!bid.possible()) return told;
  told.way_s = std::min(std::round(10.0F * bid.way_s) / 10.0F, SeatBid::kCannot_s - 0.1F);
  for (std::size_t i = 0; i < bid.sees.size(); ++i)
    told.sees[i] = std::round(255.0F * std::clamp(bid.sees[i], 0.0F, 1.0F)) / 255.0F;
  return told;
}

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

bool FleetMember::sees_followed() const {
  const FleetPerson* person = followed();
  return person && person->in_sight;
}

}  // namespace foretrack
