// SPDX-License-Identifier: Apache-2.0
// What is seen and what is believed of the person who is followed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/common/camera.hpp"
#include "core/common/geometry.hpp"

namespace foretrack {

/// Landmarks of a body in the topology of BlazePose (Bazarevsky et al. 2020).
inline constexpr int kLandmarkCount = 33;
/// Indices of the landmarks that make up the torso. Left and right are the person's own.
enum TorsoJoint : int { kLeftShoulder = 11, kRightShoulder = 12, kLeftHip = 23, kRightHip = 24 };

/// One point of a body, where the image shows it and where it is in the body.
struct Landmark {
  Vec2 image_px = Vec2::Zero();
  /// From the middle of the hips, in metres. The axes are those of the camera's optical frame (x
  /// right, y down, z forward), not the body's own.
  Vec3 body_m = Vec3::Zero();
  double visibility = 0.0;  ///< 0 to 1; 0: not seen
};

/// One look at the person: 33 landmarks, or a torso position that somebody else worked out.
struct TargetObservation {
  enum class Kind : std::uint8_t { kLandmarks, kPosition };
  double stamp_s = 0.0;  ///< when the image was taken
  Kind kind = Kind::kLandmarks;
  bool doubtful = false;  ///< it may be somebody else's

  CameraModel camera;                                ///< kLandmarks: that took the image
  std::array<Landmark, kLandmarkCount> landmarks{};  ///< kLandmarks

  Vec3 position_enu_m = Vec3::Zero();     ///< kPosition: the torso's centre
  Mat3 covariance_m2 = Mat3::Identity();  ///< kPosition: of it
  /// kPosition: where the chest points, ENU. NaN: not known.
  double body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  double body_yaw_variance_rad2 = 1.0;  ///< kPosition
  /// kPosition: where the nose points, ENU. NaN: not known.
  double head_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  double head_yaw_variance_rad2 = 1.0;  ///< kPosition
};

/// How fresh the estimate is.
enum class TrackStatus : std::uint8_t {
  kNone,      ///< nobody has been seen yet
  kTracking,  ///< measured a moment ago
  kCoasting,  ///< not seen for a moment: predicted on
  kLost,      ///< not seen for too long to say where they are
};

/// What is believed of the person at stamp_s. World ENU.
struct TargetState {
  double stamp_s = 0.0;  ///< the time that the estimate is for
  TrackStatus status = TrackStatus::kNone;
  Vec3 position_enu_m = Vec3::Zero();  ///< the torso's centre: the mean of shoulders and hips
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Mat6 covariance = Mat6::Identity();  ///< of (position, velocity), SI
  /// Where the chest points, ENU. NaN: not known.
  double body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  double body_yaw_variance_rad2 = 1.0;
  /// Where the nose points, ENU. NaN: not known.
  double head_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  double head_yaw_variance_rad2 = 1.0;
  double last_measurement_s = 0.0;  ///< stamp of the last accepted measurement

  /// Over the ground.
  double speed_m_s() const { return velocity_enu_m_s.head<2>().norm(); }
  /// True if the estimate may be predicted and planned for.
  bool usable() const {
    return status == TrackStatus::kTracking || status == TrackStatus::kCoasting;
  }
};

}  // namespace foretrack
