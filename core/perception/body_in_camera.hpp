// SPDX-License-Identifier: Apache-2.0
// Where the torso is in the camera's frame, for whoever has no vehicle.
#pragma once

#include <optional>

#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// A body in the frame of the camera that sees it.
struct BodyInCamera {
  Vec3 torso_camera_m = Vec3::Zero();  ///< the torso's centre; optical frame
  /// Where the chest points, counter-clockwise as seen from above the camera. 0: away from the
  /// camera (the person is seen from behind). ±π: into the camera. π/2: to the camera's left.
  double yaw_rad = 0.0;
};

/// The place and the heading of a person, by one image alone. The person's height is taken to be
/// params.target_height_m; a wrong height makes the range wrong by the same ratio. None: too few
/// landmarks are visible, or too few agree (see estimate_body_pose()). Cost: 30 µs.
std::optional<BodyInCamera> locate_body(const PersonPose& person, const CameraModel& camera,
                                        const PerceptionParams& params);

}  // namespace foretrack
