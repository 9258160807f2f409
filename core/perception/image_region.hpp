// SPDX-License-Identifier: Apache-2.0
// The part of an image that a network looks at.
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// A square, turned about its centre so that the person in it is upright.
struct ImageRegion {
  Vec2 centre_px = Vec2::Zero();
  double size_px = 0.0;
  double angle_rad = 0.0;  // clockwise in the image, as y points down

  /// Image point of a point of the region, whose sides are [0, 1].
  Vec2 image_px(const Vec2& in_region) const {
    return centre_px + Eigen::Rotation2Dd(angle_rad) * (size_px * (in_region - Vec2(0.5, 0.5)));
  }
};

}  // namespace foretrack
