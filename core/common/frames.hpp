// SPDX-License-Identifier: Apache-2.0
// The only place where frames are converted.
//
// World frames: ENU (x east, y north, z up; ours) and NED (x north, y east, z down; PX4's).
// Body frames: FLU (x forward, y left, z up; ours) and FRD (x forward, y right, z down; PX4's).
// Camera frame: optical (x right, y down, z forward).
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// A vector in world ENU as world NED, and the other way: (x, y, z) → (y, x, −z). For positions,
/// velocities and accelerations. It is its own inverse.
inline Vec3 swap_enu_ned(const Vec3& v) {
  return {v.y(), v.x(), -v.z()};
}

/// A vector in body FLU as body FRD, and the other way: (x, y, z) → (x, −y, −z). It is its own
/// inverse.
inline Vec3 swap_flu_frd(const Vec3& v) {
  return {v.x(), -v.y(), -v.z()};
}

/// Yaw from east, counter-clockwise (ENU) as yaw from north, clockwise (NED), and the other way:
/// π/2 − yaw, in [-π, π]. It is its own inverse.
inline double swap_yaw_enu_ned(double yaw_rad) {
  return wrap_angle(kPi / 2.0 - yaw_rad);
}
/// The same for a yaw rate: only its sign changes.
inline double swap_yaw_rate_enu_ned(double rate_rad_s) {
  return -rate_rad_s;
}

/// The attitude of body FLU in world ENU as that of body FRD in world NED (PX4's), and the other
/// way. It is its own inverse but for the sign of the quaternion, which means the same rotation.
Quat swap_attitude_enu_ned(const Quat& q);

/// Rotation that takes a vector in the optical frame of a camera that looks along body x to body
/// FLU.
Mat3 flu_from_optical();

}  // namespace foretrack
