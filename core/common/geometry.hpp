// SPDX-License-Identifier: Apache-2.0
// Short names for vectors and matrices of fixed size, and angles in the plane.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace foretrack {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Quat = Eigen::Quaterniond;  ///< q_a_b turns a vector in frame b into frame a
using Pose = Eigen::Isometry3d;   ///< T_a_b: T_a_b times a point in frame b is the point in frame a

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kGravity_m_s2 = 9.81;

/// Degrees → radians.
constexpr double rad(double deg) {
  return deg * kPi / 180.0;
}
/// Radians → degrees.
constexpr double deg(double rad_value) {
  return rad_value * 180.0 / kPi;
}

/// The same angle in [-π, π]. Cost: one remainder.
inline double wrap_angle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * kPi);
}

/// Angle of a direction in the plane, counter-clockwise from x, in [-π, π]; 0 for no direction.
inline double yaw_of(const Vec2& direction) {
  return std::atan2(direction.y(), direction.x());
}
/// The unit vector at an angle counter-clockwise from x.
inline Vec2 direction_of(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

/// Yaw of a body FLU in the world, z-y-x convention: where its x axis points on the ground plane.
/// Not defined for a body that looks straight up or down.
inline double yaw_of(const Quat& q_world_body) {
  const Vec3 forward = q_world_body * Vec3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

/// Distance on the ground plane: heights do not count.
inline double distance_xy(const Vec3& a, const Vec3& b) {
  return (a - b).head<2>().norm();
}

}  // namespace foretrack
