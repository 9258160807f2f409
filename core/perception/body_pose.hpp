// SPDX-License-Identifier: Apache-2.0
// Landmarks → pose of the human body in the camera (§III.A: perspective-n-point).
#pragma once

#include <array>
#include <optional>

#include "core/common/target.hpp"
#include "core/perception/params.hpp"

namespace foretrack {

/// Where a body is in the camera, and how well its landmarks say so.
struct BodyPose {
  /// Pose of the human frame in the optical frame. The human frame is that of Landmark::body_m: it
  /// has its origin between the hips, and axes near the camera's.
  Pose T_camera_human = Pose::Identity();
  std::array<bool, kLandmarkCount> used{};  ///< the landmarks that agree with the pose
  int used_count = 0;                       ///< how many they are
  double reprojection_rms_px = 0.0;         ///< root mean square image error of the used ones
  double noise_scale = 1.0;  ///< noise of the landmarks over what the parameters state, 1 to 3
  /// How much less sure the torso's centre is than if the whole body were seen; optical frame. From
  /// a head at the image's edge the torso is extrapolated.
  Mat3 cut_off_covariance_m2 = Mat3::Zero();

  /// A point of the human frame, in metres at the target's height, in the optical frame.
  Vec3 joint_camera_m(const Vec3& body_m) const { return T_camera_human * body_m; }
};

/// The pose of the body that fits its visible landmarks best. Outliers do no harm. It has two
/// parts:
///
/// 1. The start. The joints come with axes near the camera's, so that two landmarks give the
///    translation. The best of consensus_samples seeded pairs is taken (RANSAC with R = I; Fischler
///    and Bolles 1981; scored as MSAC, Torr and Zisserman 2000).
/// 2. The refinement. Gauss-Newton over all visible landmarks, with a loss that large errors hardly
///    enter (Geman and McClure 1985) and a weak prior on the rotation. Where the median error says
///    that the landmarks are noisier than stated, the loss is widened.
///
/// None: fewer than min_landmarks agree, or fewer than half of the visible ones, or the pose is
/// behind the camera or beyond max_range_m. Cost: about 30 µs for 33 landmarks.
std::optional<BodyPose> estimate_body_pose(const std::array<Landmark, kLandmarkCount>& landmarks,
                                           const CameraModel& camera,
                                           const PerceptionParams& params);

/// The torso's centre, the mean of both shoulders and both hips, by the pose; optical frame.
Vec3 torso_camera_m(const BodyPose& pose, const std::array<Landmark, kLandmarkCount>& landmarks,
                    const PerceptionParams& params);

/// A joint on the ray of its image point, at the depth that the pose gives it; optical frame. A
/// network's image points are more accurate than its joints in the human frame, so this is the
/// better place across the line of sight.
Vec3 seen_joint_m(const BodyPose& pose, const Landmark& landmark, const CameraModel& camera,
                  const PerceptionParams& params);

/// The number of landmarks that are visible enough (min_visibility) and finite.
int visible_count(const std::array<Landmark, kLandmarkCount>& landmarks,
                  const PerceptionParams& params);

}  // namespace foretrack
