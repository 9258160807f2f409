// SPDX-License-Identifier: Apache-2.0
// Colours of what the rasterizer drew: each pixel is shaded once.
#pragma once

#include "core/simulator/rasterizer.hpp"

namespace foretrack {

/// The sky behind everything: light at the horizon, blue above.
struct Sky {
  Eigen::Vector3f up_camera = -Eigen::Vector3f::UnitY();  ///< the world's up; optical frame
};

/// Fills in the colours of a drawn canvas: the texture of each pixel's facet in perspective, at the
/// mip level that fits its size in the image, times its light. Cost: about 10 ms for 640 × 480
/// pixels, with all drawing.
void shade(Canvas& canvas, const Sky& sky);

}  // namespace foretrack
