// SPDX-License-Identifier: Apache-2.0
// Pinhole cameras and depth images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// A pinhole camera fixed to the vehicle. Optical frame: x right, y down, z forward.
struct CameraModel {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 320.0;   // 90° horizontally
  double fy_px = 312.78;  // 75° vertically
  double cx_px = 320.0;
  double cy_px = 240.0;
  Pose T_body_camera = default_mount();  // optical frame in body FLU

  double horizontal_fov_rad() const { return 2.0 * std::atan(0.5 * width_px / fx_px); }
  double vertical_fov_rad() const { return 2.0 * std::atan(0.5 * height_px / fy_px); }

  /// Image point of a point in the optical frame; none behind the camera.
  std::optional<Vec2> project(const Vec3& point_camera_m) const {
    if (point_camera_m.z() < 1e-3) return std::nullopt;
    return Vec2(fx_px * point_camera_m.x() / point_camera_m.z() + cx_px,
                fy_px * point_camera_m.y() / point_camera_m.z() + cy_px);
  }
  bool contains(const Vec2& px) const {
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() < width_px && px.y() < height_px;
  }

  /// A camera with these full angles of view and its optical axis along body x.
  static CameraModel from_fov(int width_px, int height_px, double horizontal_rad,
                              double vertical_rad);
  static Pose default_mount();
};

/// Range along the optical axis (z), row-major, in metres; 0 or NaN: no return; > max range: free
/// to there.
struct DepthImage {
  double stamp_s = 0.0;
  CameraModel camera;
  std::vector<float> depth_m;  // width × height
};

}  // namespace foretrack
