// SPDX-License-Identifier: Apache-2.0
// Depth images of a camera whose lens may distort.
#pragma once

#include "core/common/rectify_depth.hpp"
#include "services/convert/image.hpp"

namespace foretrack {

/// Its images come out as a camera without distortion would have them. Cost: for a lens that
/// distorts, a second at the first image of a camera, 1 ns a pixel afterwards.
class DepthReader {
 public:
  explicit DepthReader(const CameraWithLens& camera) : camera_(camera) {}

  const CameraModel& model() const { return camera_.camera; }
  /// Whether it is this camera.
  bool is(const CameraWithLens& other) const;
  /// As from_idl of an image of this camera's size.
  Converted<DepthImage> convert(const sensor_msgs::msg::Image& message,
                                std::vector<float> buffer = {});

 private:
  CameraWithLens camera_;
  PixelMap straightening_;  // empty until an image of a lens that distorts comes
  std::vector<float> distorted_;
};

}  // namespace foretrack
