// SPDX-License-Identifier: Apache-2.0
// Colour images and lenses.
#pragma once

#include "core/common/image.hpp"
#include "core/perception/lens.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// rgb8, bgr8 or mono8, rows of any padding, of the camera's size. `buffer` is the memory of an
/// older image, so that nothing is allocated after the first one.
Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                                 std::vector<std::uint8_t> buffer = {});

/// A camera whose images are not rectified.
struct CameraWithLens {
  CameraModel camera;
  Lens lens;
};
Converted<CameraWithLens> lens_from_idl(const sensor_msgs::msg::CameraInfo& in,
                                        const Pose& T_body_camera);

}  // namespace foretrack
