// SPDX-License-Identifier: Apache-2.0
// Colour images in.
#pragma once

#include <vector>

#include "core/common/camera.hpp"
#include "core/common/image.hpp"
#include "sensor_msgs/msg/Image.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422 (that is uyvy) or yuv422_yuy2, rows of any
/// padding, of the camera's size; mono16 little-endian. `buffer` is the memory of an older image,
/// so that nothing is allocated after the first one.
Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                                 std::vector<std::uint8_t> buffer = {});

}  // namespace foretrack
