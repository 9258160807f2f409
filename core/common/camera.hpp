// SPDX-License-Identifier: Apache-2.0
// Pinhole cameras and depth images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// A pinhole camera that is fixed to the vehicle, without lens distortion (see lens.hpp for lenses
/// that distort). Optical frame: x right, y down, z forward. Image points are in pixels from the
/// upper left corner of the image; the middle of the first pixel is (0.5, 0.5).
struct CameraModel {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 320.0;   ///< focal length along x: 90° of view across the image
  double fy_px = 312.78;  ///< focal length along y: 75° of view from top to bottom
  double cx_px = 320.0;   ///< image point of the optical axis
  double cy_px = 240.0;
  Pose T_body_camera = default_mount();  ///< place and attitude of the optical frame in body FLU

  /// Full angle of view from the left to the right side.
  double horizontal_fov_rad() const { return 2.0 * std::atan(0.5 * width_px / fx_px); }
  /// Full angle of view from the top to the bottom.
  double vertical_fov_rad() const { return 2.0 * std::atan(0.5 * height_px / fy_px); }

  /// Image point of a point in the optical frame. It may be outside the image. None for a point
  /// behind the camera or nearer than 1 mm to its plane.
  std::optional<Vec2> project(const Vec3& point_camera_m) const {
    if (point_camera_m.z() < 1e-3) return std::nullopt;
    return Vec2(fx_px * point_camera_m.x() / point_camera_m.z() + cx_px,
                fy_px * point_camera_m.y() / point_camera_m.z() + cy_px);
  }
  /// True if the image point is inside the image.
  bool contains(const Vec2& px) const {
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() < width_px && px.y() < height_px;
  }

  /// A camera with these full angles of view. It sits at the body's origin and looks along body x.
  /// Preconditions: sizes above 0, angles between 0 and π.
  static CameraModel from_fov(int width_px, int height_px, double horizontal_rad,
                              double vertical_rad);
  /// At the body's origin, the optical axis along body x.
  static Pose default_mount();
};

/// What a depth camera measured in one instant.
struct DepthImage {
  double stamp_s = 0.0;  ///< when it was taken
  CameraModel camera;
  /// width × height values, row by row from the top. Each is the distance along the optical axis
  /// (z of the point, not the length of the ray). 0 or NaN: no return, nothing is known. Beyond the
  /// camera's range: the way is free as far as the range.
  std::vector<float> depth_m;
};

}  // namespace foretrack
