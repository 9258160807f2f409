// SPDX-License-Identifier: Apache-2.0
// A camera's calibration as ROS' camera_calibration writes it.
#pragma once

#include <string>

#include "core/common/calibrated_camera.hpp"

namespace foretrack {

/// image_width, image_height, camera_matrix, distortion_model (plumb_bob, rational_polynomial,
/// equidistant, none) and distortion_coefficients, each matrix as {data: [...]} or as the list
/// alone; or what `ros2 topic echo --once` prints of a camera_info: width, height, k,
/// distortion_model and d. Throws std::invalid_argument that names every fault with its line:
/// numbers that no camera has among them.
CameraWithLens load_calibration(const std::string& file);

/// "640 × 480 px, 63° × 50° of view", for people to compare with what they know of the camera.
std::string describe(const CameraWithLens& camera);

}  // namespace foretrack
