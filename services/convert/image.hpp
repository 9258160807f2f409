// SPDX-License-Identifier: Apache-2.0
// Cameras and depth images.
#pragma once

#include <vector>

#include "core/common/camera.hpp"
#include "core/common/image.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// A rectified camera: no distortion. Its mount is not part of the message.
void to_idl(const CameraModel& camera, double stamp_s, sensor_msgs::msg::CameraInfo& out);
Converted<CameraModel> from_idl(const sensor_msgs::msg::CameraInfo& in, const Pose& T_body_camera);

/// As rgb8.
void to_idl(const RgbImage& image, double stamp_s, sensor_msgs::msg::Image& out);

/// As 32FC1: metres.
void to_idl(const DepthImage& image, sensor_msgs::msg::Image& out);
/// Little-endian 32FC1 (metres) or 16UC1 (millimetres), of the camera's size. `buffer` is the
/// memory of an older image, so that nothing is allocated after the first one.
Converted<DepthImage> from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                               std::vector<float> buffer = {});

}  // namespace foretrack
