// SPDX-License-Identifier: Apache-2.0
// Colours of what the rasterizer drew: each pixel is shaded once.
#pragma once

#include "core/simulator/rasterizer.hpp"

namespace foretrack {

/// Up in the optical frame decides where the sky is light.
struct Sky {
  Eigen::Vector3f up_camera = -Eigen::Vector3f::UnitY();
};

/// Fills in the colours. Cost: about 10 ms for 640 × 480 pixels, with all drawing.
void shade(Canvas& canvas, const Sky& sky);

}  // namespace foretrack
