// SPDX-License-Identifier: Apache-2.0
// A camera's calibration as ROS' camera_calibration writes it.
#pragma once

#include <string>

#include "core/perception/lens.hpp"

namespace foretrack {

struct Calibration {
  CameraModel camera;
  Lens lens;
};

/// image_width, image_height, camera_matrix, distortion_model (plumb_bob, rational_polynomial,
/// equidistant) and distortion_coefficients. Throws std::invalid_argument that names every fault
/// with its line.
Calibration load_calibration(const std::string& file);

}  // namespace foretrack
