// SPDX-License-Identifier: Apache-2.0
// Names for the fixed-size vectors used everywhere, and angles in the plane.
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
using Quat = Eigen::Quaterniond;
using Pose = Eigen::Isometry3d;  // T_a_b: a point in frame b, times T_a_b, is the point in frame a

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kGravity_m_s2 = 9.81;

constexpr double rad(double deg) {
  return deg * kPi / 180.0;
}
constexpr double deg(double rad_value) {
  return rad_value * 180.0 / kPi;
}

/// The same angle in [-π, π]. Cost: one remainder.
inline double wrap_angle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * kPi);
}

inline double yaw_of(const Vec2& direction) {
  return std::atan2(direction.y(), direction.x());
}
inline Vec2 direction_of(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

/// Yaw of a body FLU attitude in the world, z-y-x convention.
inline double yaw_of(const Quat& q_world_body) {
  const Vec3 forward = q_world_body * Vec3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

inline double distance_xy(const Vec3& a, const Vec3& b) {
  return (a - b).head<2>().norm();
}

}  // namespace foretrack
