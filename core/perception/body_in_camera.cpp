// SPDX-License-Identifier: Apache-2.0
#include "core/perception/body_in_camera.hpp"

#include "core/perception/body_pose.hpp"

namespace foretrack {

std::optional<BodyInCamera> locate_body(const PersonPose& person, const CameraModel& camera,
                                        const PerceptionParams& params) {
  const TargetObservation observation = to_observation(person, 0.0, camera, params);
  const auto pose = estimate_body_pose(observation.landmarks, camera, params);
  if (!pose) return std::nullopt;
  BodyInCamera body;
  body.torso_camera_m = torso_camera_m(*pose, observation.landmarks, params);
  // Ahead is z, to the left is −x; the chest is a quarter turn clockwise of right → left shoulder.
  const auto seen = [&](TorsoJoint j) {
    return seen_joint_m(*pose, observation.landmarks[j], camera, params);
  };
  const Vec3 across = seen(kLeftShoulder) - seen(kRightShoulder);
  body.yaw_rad = std::atan2(-across.z(), -across.x());
  return body;
}

}  // namespace foretrack
