// SPDX-License-Identifier: Apache-2.0
// People in frames, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/perception/body_in_camera.hpp"

namespace foretrack {

/// A person, and where they are in the camera's frame if that is known.
struct SeenPerson {
  PersonPose pose;
  std::optional<BodyInCamera> place;
};
struct SeenFrame {
  double stamp_s = 0.0;
  std::string file;  // of pictures
  std::vector<SeenPerson> people;
};

/// {stamp_s, people: [{landmarks: [33 × {x_px, y_px, visibility, world_m}], position_camera_m,
/// yaw_rad, score}]}, and `file` for pictures. Image points are those of the picture as it is, with
/// its lens' distortion. world_m is what the network says, of a person of 1.62 m. Position and yaw
/// are null if they are not known.
nlohmann::ordered_json json_of(const SeenFrame& frame);

}  // namespace foretrack
