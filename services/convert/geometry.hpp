// SPDX-License-Identifier: Apache-2.0
// Stamps, headers, vectors and poses: the parts that all messages share.
#pragma once

#include <array>
#include <cmath>

#include "builtin_interfaces/msg/Time.h"
#include "geometry_msgs/msg/Point.h"
#include "geometry_msgs/msg/Pose.h"
#include "geometry_msgs/msg/Quaternion.h"
#include "geometry_msgs/msg/Vector3.h"
#include "services/convert/checks.hpp"
#include "std_msgs/msg/Header.h"

namespace foretrack {

inline constexpr char kWorldFrame[] = "map";  // ENU, REP-105
inline constexpr char kBodyFrame[] = "base_link";
inline constexpr char kCameraFrame[] = "camera_optical_frame";

/// Rounds to a nanosecond. Precondition: 0 ≤ stamp_s < 2³¹.
inline builtin_interfaces::msg::Time to_time(double stamp_s) {
  const double whole = std::floor(stamp_s);
  double ns = std::round((stamp_s - whole) * 1e9);
  const double carry = ns >= 1e9 ? 1.0 : 0.0;
  ns -= carry * 1e9;
  builtin_interfaces::msg::Time time;
  time.sec(static_cast<std::int32_t>(whole + carry));
  time.nanosec(static_cast<std::uint32_t>(ns));
  return time;
}
inline double seconds(const builtin_interfaces::msg::Time& time) {
  return time.sec() + 1e-9 * time.nanosec();
}

inline void set_header(std_msgs::msg::Header& header, double stamp_s,
                       std::string_view frame = kWorldFrame) {
  header.stamp(to_time(stamp_s));
  header.frame_id(std::string(frame));
}
/// The stamp and the frame.
inline void check_header(Checks& checks, const std_msgs::msg::Header& header,
                         std::string_view frame = kWorldFrame) {
  checks.stamp("header.stamp", header.stamp());
  checks.frame("header.frame_id", header.frame_id(), frame);
}

template <class T>
Vec3 to_vec3(const std::array<T, 3>& a) {
  return {a[0], a[1], a[2]};
}
inline std::array<double, 3> to_array(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline std::array<float, 3> to_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
/// A row-major matrix.
template <int N>
std::array<double, N * N> to_rows(const Eigen::Matrix<double, N, N>& m) {
  std::array<double, N * N> rows;
  for (int i = 0; i < N * N; ++i) rows[i] = m(i / N, i % N);
  return rows;
}
template <int N>
Eigen::Matrix<double, N, N> from_rows(const std::array<double, N * N>& rows) {
  Eigen::Matrix<double, N, N> m;
  for (int i = 0; i < N * N; ++i) m(i / N, i % N) = rows[i];
  return m;
}

/// Point and Vector3 have the same fields.
template <class Xyz>
void set_xyz(Xyz& out, const Vec3& v) {
  out.x(v.x());
  out.y(v.y());
  out.z(v.z());
}
template <class Xyz>
Vec3 xyz(const Xyz& in) {
  return {in.x(), in.y(), in.z()};
}
template <class Xyz>
void check_xyz(Checks& checks, std::string_view field, const Xyz& in, double limit) {
  checks.within(field, in.x(), limit);
  checks.within(field, in.y(), limit);
  checks.within(field, in.z(), limit);
}

void set_pose(geometry_msgs::msg::Pose& out, const Pose& pose);
void set_orientation(geometry_msgs::msg::Quaternion& out, const Quat& q);
/// Normalised; w, x, y, z = 0, 0, 0, 0 and NaN are faults.
Quat orientation(const geometry_msgs::msg::Quaternion& in);
void check_pose(Checks& checks, std::string_view position_field, std::string_view rotation_field,
                const geometry_msgs::msg::Pose& in);
/// Precondition: checked.
Pose to_pose(const geometry_msgs::msg::Pose& in);

}  // namespace foretrack
