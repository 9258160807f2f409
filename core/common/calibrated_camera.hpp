// SPDX-License-Identifier: Apache-2.0
// What a camera's calibration says, and whether a camera can be so.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/common/lens.hpp"

namespace foretrack {

/// A camera whose images are not rectified. Points are worked out for `camera`, which does not
/// distort.
struct CameraWithLens {
  CameraModel camera;
  Lens lens;

  /// Full angle of view across the image, and from its top to its bottom, through the lens' own
  /// projection (a fisheye sees as many radians as it has pixels for), without its distortion.
  double horizontal_view_rad() const;
  double vertical_view_rad() const;
};

/// What no camera's matrix has, each with its numbers, in words; empty: the matrix is plausible.
/// k_px: row by row fx 0 cx, 0 fy cy, 0 0 1, in pixels.
std::vector<std::string> faults_of_matrix(int width_px, int height_px,
                                          const std::array<double, 9>& k_px);

/// Precondition: no faults of the matrix.
CameraModel camera_of_matrix(int width_px, int height_px, const std::array<double, 9>& k_px);

/// Why camera and lens cannot be of one camera, with numbers: an angle of view that no lens has, or
/// a distortion that folds the image over within it. Empty: they can.
std::string fault_of(const CameraWithLens& camera);

}  // namespace foretrack
