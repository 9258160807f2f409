// SPDX-License-Identifier: Apache-2.0
// What is seen and what is believed of the person who is followed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/common/camera.hpp"
#include "core/common/geometry.hpp"

namespace foretrack {

inline constexpr int kLandmarkCount = 33;  // BlazePose topology
enum TorsoJoint : int { kLeftShoulder = 11, kRightShoulder = 12, kLeftHip = 23, kRightHip = 24 };

struct Landmark {
  Vec2 image_px = Vec2::Zero();
  Vec3 body_m =
      Vec3::Zero();  // human body frame, axes as the camera's optical frame (x right, y down)
  double visibility = 0.0;  // [0, 1]; 0: not seen
};

/// One look at the person: 33 landmarks, or a torso position that somebody else worked out.
struct TargetObservation {
  enum class Kind : std::uint8_t { kLandmarks, kPosition };
  double stamp_s = 0.0;  // of the image
  Kind kind = Kind::kLandmarks;
  bool doubtful = false;  // it may be somebody else's
  // kLandmarks
  CameraModel camera;
  std::array<Landmark, kLandmarkCount> landmarks{};
  // kPosition
  Vec3 position_enu_m = Vec3::Zero();
  Mat3 covariance_m2 = Mat3::Identity();
  double body_yaw_rad = std::numeric_limits<double>::quiet_NaN();  // NaN: not known
  double body_yaw_variance_rad2 = 1.0;
};

enum class TrackStatus : std::uint8_t { kNone, kTracking, kCoasting, kLost };

/// The estimate. Position is that of the torso's centre.
struct TargetState {
  double stamp_s = 0.0;
  TrackStatus status = TrackStatus::kNone;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Mat6 covariance = Mat6::Identity();  // of (position, velocity)
  double body_yaw_rad =
      std::numeric_limits<double>::quiet_NaN();  // where the chest points; NaN: not known
  double body_yaw_variance_rad2 = 1.0;
  double last_measurement_s = 0.0;  // stamp of the last accepted measurement
  double speed_m_s() const { return velocity_enu_m_s.head<2>().norm(); }
  bool usable() const {
    return status == TrackStatus::kTracking || status == TrackStatus::kCoasting;
  }
};

}  // namespace foretrack
