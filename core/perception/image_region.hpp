// SPDX-License-Identifier: Apache-2.0
// The part of an image that a network looks at.
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// A square part of an image. It may be turned, so that a person who leans is upright in it, and it
/// may reach beyond the image.
struct ImageRegion {
  Vec2 centre_px = Vec2::Zero();
  double size_px = 0.0;    ///< length of a side
  double angle_rad = 0.0;  ///< by which it is turned about its centre; clockwise in the image

  /// The image point of a point of the region. The region's own coordinates go from (0, 0) at its
  /// upper left corner to (1, 1) at its lower right one.
  Vec2 image_px(const Vec2& in_region) const {
    return centre_px + Eigen::Rotation2Dd(angle_rad) * (size_px * (in_region - Vec2(0.5, 0.5)));
  }
};

/// Side of the region that the landmark network is given, over the height of who stands in it.
inline constexpr double kRegionOverBody = 1.25;

}  // namespace foretrack
