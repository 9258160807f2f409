// SPDX-License-Identifier: Apache-2.0
// The only place where frames are converted: world ENU ↔ NED, body FLU ↔ FRD, body FLU ↔ optical.
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// (x, y, z) → (y, x, −z). Its own inverse, for positions, velocities and accelerations.
inline Vec3 swap_enu_ned(const Vec3& v) {
  return {v.y(), v.x(), -v.z()};
}

/// (x, y, z) → (x, −y, −z). Its own inverse.
inline Vec3 swap_flu_frd(const Vec3& v) {
  return {v.x(), -v.y(), -v.z()};
}

/// yaw_ned = π/2 − yaw_enu. Its own inverse.
inline double swap_yaw_enu_ned(double yaw_rad) {
  return wrap_angle(kPi / 2.0 - yaw_rad);
}
/// Yaw rates change their sign between ENU and NED.
inline double swap_yaw_rate_enu_ned(double rate_rad_s) {
  return -rate_rad_s;
}

/// q_enu_flu ↔ q_ned_frd (PX4's attitude). Its own inverse up to the sign of the quaternion.
Quat swap_attitude_enu_ned(const Quat& q);

/// Rotation of an optical frame (x right, y down, z forward) in a FLU frame looking along x.
Mat3 flu_from_optical();

}  // namespace foretrack
