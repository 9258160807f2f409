// SPDX-License-Identifier: Apache-2.0
// Where the torso is in the camera's frame, for whoever has no vehicle.
#pragma once

#include <optional>

#include "core/perception/perceive_image.hpp"

namespace foretrack {

struct BodyInCamera {
  Vec3 torso_camera_m = Vec3::Zero();  // optical frame: x right, y down, z forward
  /// Where the chest points, about the camera's up axis, counter-clockwise from above: 0 is where
  /// the camera looks (the person is seen from behind), ±π is into the camera, π/2 is to its left.
  double yaw_rad = 0.0;
};

/// None: too few landmarks are visible or agree. The person's height is params.target_height_m.
std::optional<BodyInCamera> locate_body(const PersonPose& person, const CameraModel& camera,
                                        const PerceptionParams& params);

}  // namespace foretrack
