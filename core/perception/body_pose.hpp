// SPDX-License-Identifier: Apache-2.0
// Landmarks → pose of the human body in the camera (§III.A: perspective-n-point).
#pragma once

#include <array>
#include <optional>

#include "core/common/target.hpp"
#include "core/perception/params.hpp"

namespace foretrack {

struct BodyPose {
  Pose T_camera_human = Pose::Identity();
  std::array<bool, kLandmarkCount> used{};  // agrees with the pose
  int used_count = 0;
  double reprojection_rms_px = 0.0;  // of the used landmarks
  double noise_scale = 1.0;          // of the landmarks, over the noise that the parameters state

  /// A joint in the optical frame, from its place in the human frame.
  Vec3 joint_camera_m(const Vec3& body_m) const { return T_camera_human * body_m; }
};

/// Least squares over all visible landmarks, robust to outliers. Because the joints come with axes
/// near the camera's, two landmarks fix the translation: the best of a few seeded pairs (RANSAC
/// with R = I) is the start, a Gauss-Newton with a redescending loss (Geman and McClure) and a
/// weak prior on the rotation the refinement. If the landmarks turn out to be noisier than stated
/// (by their median error), the loss is widened. None: fewer than min_landmarks or than half of the
/// visible ones agree, or the pose is behind the camera or out of range. Cost: about 30 µs for 33
/// landmarks.
std::optional<BodyPose> estimate_body_pose(const std::array<Landmark, kLandmarkCount>& landmarks,
                                           const CameraModel& camera,
                                           const PerceptionParams& params);

/// The middle of shoulders and hips, by the pose; optical frame.
Vec3 torso_camera_m(const BodyPose& pose, const std::array<Landmark, kLandmarkCount>& landmarks,
                    const PerceptionParams& params);

/// A joint where the image shows it, at the depth that the pose gives it; optical frame. Across the
/// line of sight, a network's image points are more accurate than its joints in the human frame.
Vec3 seen_joint_m(const BodyPose& pose, const Landmark& landmark, const CameraModel& camera,
                  const PerceptionParams& params);

/// Landmarks that are visible enough and finite.
int visible_count(const std::array<Landmark, kLandmarkCount>& landmarks,
                  const PerceptionParams& params);

}  // namespace foretrack
