// SPDX-License-Identifier: Apache-2.0
// Cameras as sensor_msgs/CameraInfo has them.
#pragma once

#include <string_view>

#include "core/common/calibrated_camera.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "services/convert/checks.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {

/// A rectified camera: no distortion. Its mount is not part of the message.
void to_idl(const CameraModel& camera, double stamp_s, sensor_msgs::msg::CameraInfo& out,
            std::string_view frame = kCameraFrame);

/// A camera whose images need not be rectified; its mount is the default one. A matrix or a
/// distortion that no camera has is a fault ("k", "d").
Converted<CameraWithLens> from_idl(const sensor_msgs::msg::CameraInfo& in);

}  // namespace foretrack
