// SPDX-License-Identifier: Apache-2.0
// The vehicle's state, its recent history, and what is commanded to its flight controller.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// World ENU, body FLU.
struct VehicleState {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Quat q_world_body = Quat::Identity();
  Vec3 angular_velocity_body_rad_s = Vec3::Zero();

  double yaw_rad() const { return yaw_of(q_world_body); }
  Pose T_world_body() const {
    Pose pose = Pose::Identity();
    pose.linear() = q_world_body.toRotationMatrix();
    pose.translation() = position_enu_m;
    return pose;
  }
};

/// The last states, so that an image meets the pose at its own stamp. Fixed capacity, oldest
/// dropped.
class VehicleHistory {
 public:
  explicit VehicleHistory(std::size_t capacity = 256) { states_.reserve(capacity); }
  /// Ignores states that are not newer than the newest one.
  void add(const VehicleState& state);
  /// Interpolated (position linear, attitude slerp); none outside the history by more than slack_s.
  std::optional<VehicleState> at(double stamp_s, double slack_s = 0.05) const;
  const VehicleState* newest() const;

 private:
  std::vector<VehicleState> states_;  // a ring once full
  std::size_t next_ = 0;
};

/// What the safety gate commands. NaN in a field: not controlled.
struct Setpoint {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  Vec3 jerk_enu_m_s3 = Vec3::Zero();
  double yaw_rad = 0.0;  // ENU
  double yaw_rate_rad_s = 0.0;
};

/// What the flight controller says of itself.
struct AutopilotStatus {
  double stamp_s = -1.0;  // < 0: never heard of
  bool armed = false;
  bool offboard = false;
  bool failsafe = false;
};

}  // namespace foretrack
