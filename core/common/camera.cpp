// SPDX-License-Identifier: Apache-2.0
#include "core/common/camera.hpp"

#include "core/common/frames.hpp"

namespace foretrack {

Pose CameraModel::default_mount() {
  Pose mount = Pose::Identity();
  mount.linear() = flu_from_optical();
  return mount;
}

CameraModel CameraModel::from_fov(int width_px, int height_px, double horizontal_rad,
                                  double vertical_rad) {
  CameraModel camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = 0.5 * width_px / std::tan(0.5 * horizontal_rad);
  camera.fy_px = 0.5 * height_px / std::tan(0.5 * vertical_rad);
  camera.cx_px = 0.5 * width_px;
  camera.cy_px = 0.5 * height_px;
  return camera;
}

}  // namespace foretrack
