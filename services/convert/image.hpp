// SPDX-License-Identifier: Apache-2.0
// Depth images in both directions; colour images out.
#pragma once

#include <vector>

#include "core/common/camera.hpp"
#include "core/common/image.hpp"
#include "sensor_msgs/msg/Image.h"
#include "services/convert/camera_info.hpp"

namespace foretrack {

/// As rgb8.
void to_idl(const RgbImage& image, double stamp_s, sensor_msgs::msg::Image& out,
            std::string_view frame = kCameraFrame);

/// As 32FC1: metres.
void to_idl(const DepthImage& image, sensor_msgs::msg::Image& out,
            std::string_view frame = kCameraFrame);
/// Little-endian 32FC1 (metres), 16UC1 or mono16 (millimetres), of the camera's size. `buffer` is
/// the memory of an older image, so that nothing is allocated after the first one.
Converted<DepthImage> from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                               std::vector<float> buffer = {});

}  // namespace foretrack
