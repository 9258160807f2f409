// SPDX-License-Identifier: Apache-2.0
// Pictures out, as JPEG.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/image.hpp"

namespace foretrack {

/// `quality`: 1 to 100. `out` keeps its memory; it is empty if the picture cannot be encoded (no
/// pixel, a side above 65500, no memory). Cost: 2 to 4 ms for 640 × 480 pixels.
void encode_jpeg(const RgbImage& image, int quality, std::vector<std::uint8_t>& out);

}  // namespace foretrack
