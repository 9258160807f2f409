// SPDX-License-Identifier: Apache-2.0
// Whether two people are where they may be taken for each other.
#pragma once

#include "core/common/moving_body.hpp"

namespace foretrack {

/// They stand side by side, within meet_m, or one before the other as the vehicle sees them.
inline bool meets(const MovingBody& person, const MovingBody& other, const Vec3& vehicle_enu_m,
                  double meet_m) {
  constexpr double kInLine_rad = 0.12;
  constexpr double kInLine_m = 3.0;  // farther before or behind, nobody looks as tall
  const Vec2 to_person = (person.position_enu_m - vehicle_enu_m).head<2>();
  const Vec2 to_other = (other.position_enu_m - vehicle_enu_m).head<2>();
  const double apart_m = (to_person - to_other).norm();
  if (apart_m <= meet_m) return true;
  return apart_m <= kInLine_m &&
         std::abs(wrap_angle(yaw_of(to_person) - yaw_of(to_other))) <= kInLine_rad;
}

}  // namespace foretrack
