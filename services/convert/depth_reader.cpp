// SPDX-License-Identifier: Apache-2.0
#include "services/convert/depth_reader.hpp"

namespace foretrack {

bool DepthReader::is(const CameraWithLens& other) const {
  const CameraModel &a = camera_.camera, &b = other.camera;
  return a.width_px == b.width_px && a.height_px == b.height_px && a.fx_px == b.fx_px &&
         a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px &&
         camera_.lens.model == other.lens.model &&
         camera_.lens.coefficients == other.lens.coefficients;
}

Converted<DepthImage> DepthReader::convert(const sensor_msgs::msg::Image& message,
                                           std::vector<float> buffer) {
  auto image = from_idl(message, camera_.camera, std::move(buffer));
  if (!image || !camera_.lens.distorts()) return image;
  if (straightening_.empty()) straightening_ = straightening(camera_);
  std::swap(distorted_, image->depth_m);
  rectify_depth(straightening_, distorted_, image->depth_m);
  return image;
}

}  // namespace foretrack
