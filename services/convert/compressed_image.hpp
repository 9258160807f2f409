// SPDX-License-Identifier: Apache-2.0
// Compressed colour images in.
#pragma once

#include <vector>

#include "core/common/camera.hpp"
#include "core/common/image.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// A JPEG or PNG picture of the camera's size; which one, its own first bytes say. Its size is
/// compared before anything is decoded. `buffer` is the memory of an older image. Cost: 3 to 6 ms
/// for 640 × 480 pixels.
Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::CompressedImage& in,
                                 const CameraModel& camera, std::vector<std::uint8_t> buffer = {});

/// The same of whatever size the picture says, up to 4096 px a side.
Converted<RgbImage> rgb_of_any_size(const sensor_msgs::msg::CompressedImage& in,
                                    std::vector<std::uint8_t> buffer = {});

}  // namespace foretrack
