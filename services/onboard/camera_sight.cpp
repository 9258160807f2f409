// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/camera_sight.hpp"

#include <fmt/format.h>

#include <cmath>

namespace foretrack {

void CameraSight::look_at_color(std::span<const std::uint8_t> values) {
  if (values.empty()) return;  // no image
  fault_ = watch_color(watch_, statistics_of(values), moved_m(), service_.clock().steady_s(), {});
}

void CameraSight::look_at_depth(std::span<const float> depths_m) {
  if (depths_m.empty()) return;
  fault_ = watch_depth(watch_, statistics_of(depths_m), moved_m(), service_.clock().steady_s(), {});
}

std::string CameraSight::trouble(std::string_view which) const {
  if (fault_ == ImageFault::kNone) return "";
  return fmt::format("the {} images are {}", which, to_string(fault_));
}

// A radian counts as a metre.
double CameraSight::moved_m() {
  const VehicleState* now = vehicle_.newest();
  if (!now) return 0.0;
  double moved_m = 0.0;
  if (looked_from_)
    moved_m = (now->position_enu_m - looked_from_->position_enu_m).norm() +
              std::abs(wrap_angle(now->yaw_rad() - looked_from_->yaw_rad()));
  looked_from_ = *now;
  return moved_m;
}

}  // namespace foretrack
