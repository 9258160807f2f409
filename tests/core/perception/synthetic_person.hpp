// SPDX-License-Identifier: Apache-2.0
// A walking person with known truth, and what a camera 2 m away makes of them.
#pragma once

#include "core/common/random.hpp"
#include "core/common/target.hpp"
#include "core/common/vehicle.hpp"

namespace foretrack::test {

struct PersonState {
  Vec3 hips_enu_m = Vec3(0, 0, 0.95);
  Vec3 velocity_enu_m_s = Vec3::Zero();
  double yaw_rad = 0.0;  // of the body
  double stride_rad = 0.0;
};

/// The 33 joints of a person 1.75 m tall in a FLU frame between the hips.
inline std::array<Vec3, kLandmarkCount> joints_of(double stride_rad) {
  std::array<Vec3, kLandmarkCount> j;
  const double swing = 0.25 * std::sin(stride_rad);
  const auto both = [&](int left, double x, double y, double z, double phase = 0.0) {
    j[left] = Vec3(x + phase * swing, y, z);
    j[left + 1] = Vec3(x - phase * swing, -y, z);
  };
  j[0] = Vec3(0.13, 0, 0.66);
  for (int k = 0; k < 3; ++k) {
    j[1 + k] = Vec3(0.10, 0.02 + 0.015 * k, 0.70);
    j[4 + k] = Vec3(0.10, -0.02 - 0.015 * k, 0.70);
  }
  both(7, 0.02, 0.075, 0.68);
  both(9, 0.10, 0.03, 0.61);
  both(11, 0.0, 0.18, 0.50);
  both(13, 0.02, 0.24, 0.22, -0.5);
  both(15, 0.10, 0.25, 0.0, -1.0);
  for (int k = 17; k <= 21; k += 2) both(k, 0.12, 0.25, -0.06 - 0.01 * (k - 17), -1.1);
  both(23, 0.0, 0.11, 0.0);
  both(25, 0.05, 0.11, -0.43, 0.6);
  both(27, 0.0, 0.11, -0.84, 1.2);
  both(29, -0.05, 0.11, -0.90, 1.2);
  both(31, 0.14, 0.12, -0.92, 1.2);
  return j;
}

inline Pose T_world_person(const PersonState& person) {
  Pose T = Pose::Identity();
  T.linear() = Eigen::AngleAxisd(person.yaw_rad, Vec3::UnitZ()).toRotationMatrix();
  T.translation() = person.hips_enu_m;
  return T;
}

inline Vec3 torso_of(const PersonState& person) {
  const auto joints = joints_of(person.stride_rad);
  Vec3 sum = Vec3::Zero();
  for (const int k : {kLeftShoulder, kRightShoulder, kLeftHip, kRightHip}) sum += joints[k];
  return T_world_person(person) * (0.25 * sum);
}

/// A vehicle at a place, looking level at a point.
inline VehicleState vehicle_at(double stamp_s, const Vec3& position, const Vec3& looks_at) {
  VehicleState v;
  v.stamp_s = stamp_s;
  v.position_enu_m = position;
  v.q_world_body =
      Quat(Eigen::AngleAxisd(yaw_of((looks_at - position).head<2>().eval()), Vec3::UnitZ()));
  return v;
}

struct LandmarkNoise {
  double image_px = 2.0;
  double joint_m = 0.03;
  static LandmarkNoise none() { return {0.0, 0.0}; }
};

inline TargetObservation observe(const PersonState& person, const VehicleState& vehicle,
                                 const LandmarkNoise& noise, Random& random,
                                 const CameraModel& camera = {}) {
  TargetObservation o;
  o.stamp_s = vehicle.stamp_s;
  o.camera = camera;
  const Pose T_camera_world = (vehicle.T_world_body() * camera.T_body_camera).inverse();
  const auto joints = joints_of(person.stride_rad);
  for (int k = 0; k < kLandmarkCount; ++k) {
    const Vec3 world = T_world_person(person) * joints[k];
    const auto px = camera.project(T_camera_world * world);
    Landmark& l = o.landmarks[k];
    l.body_m = T_camera_world.linear() * (world - person.hips_enu_m);
    for (int a = 0; a < 3; ++a) l.body_m[a] += random.normal(0.0, noise.joint_m);
    if (!px) continue;
    l.image_px = *px + Vec2(random.normal(), random.normal()) * noise.image_px;
    l.visibility = camera.contains(l.image_px) ? 0.9 : 0.1;
  }
  return o;
}

/// Walks along x, turns by `turn_rad` from `turn_s` on with 3 m/s² of centripetal acceleration. The
/// body begins to turn body_lead_s earlier.
struct Walk {
  double speed_m_s = 1.5;
  double turn_s = 3.0;
  double turn_rad = kPi / 2.0;
  double body_lead_s = 0.3;

  double turn_rate() const { return std::copysign(3.0 / speed_m_s, turn_rad); }
  double heading(double t_s) const {
    return std::clamp((t_s - turn_s) * turn_rate(), std::min(0.0, turn_rad),
                      std::max(0.0, turn_rad));
  }
  PersonState at(double t_s) const {
    PersonState p;
    const double w = turn_rate(), r = speed_m_s / w, turned = heading(t_s);
    const double before_s = std::min(t_s, turn_s);
    const double after_s = std::max(0.0, t_s - turn_s - turn_rad / w);
    p.hips_enu_m.x() = speed_m_s * before_s + r * std::sin(turned);
    p.hips_enu_m.y() = r * (1.0 - std::cos(turned));
    p.hips_enu_m.head<2>() += speed_m_s * after_s * direction_of(turn_rad);
    if (after_s <= 0.0 && t_s <= turn_s) p.hips_enu_m.y() = 0.0;
    p.velocity_enu_m_s.head<2>() = speed_m_s * direction_of(turned);
    p.yaw_rad = heading(t_s + body_lead_s);
    p.stride_rad = 2.0 * kPi * 0.9 * t_s;
    return p;
  }
};

}  // namespace foretrack::test
