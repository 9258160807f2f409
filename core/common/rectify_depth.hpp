// SPDX-License-Identifier: Apache-2.0
// Depth images of cameras whose lens distorts, as a camera without distortion would have them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/calibrated_camera.hpp"

namespace foretrack {

/// Of each pixel of the straight image, row by row, the pixel of the distorted one in which the
/// same ray ends; −1: it ends outside.
using PixelMap = std::vector<std::int32_t>;

/// The map of a camera. Cost: 2 µs a pixel; once a camera.
PixelMap straightening(const CameraWithLens& camera);

/// The depths of the straight image; 0 (no return) where the map has none. Depths are not
/// interpolated: between a near and a far thing is nothing. `straight` is as long as the map
/// afterwards. Precondition: the map's indices are within `distorted`.
void rectify_depth(const PixelMap& map, const std::vector<float>& distorted,
                   std::vector<float>& straight);

}  // namespace foretrack
