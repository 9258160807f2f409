// SPDX-License-Identifier: Apache-2.0
// A region of an image, resampled to the square that a network reads.
#pragma once

#include <span>

#include "core/common/image.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

/// What is seen outside the image: black, or the nearest pixel of the image.
enum class Border : std::uint8_t { kBlack, kRepeated };

/// Fills `out` with side × side pixels of three floats, row by row from the top of the region. Each
/// float is level × (byte / 255) + offset, interpolated linearly between the four nearest pixels.
/// Preconditions: the image has pixels, `out` has 3 × side × side floats. Cost: 1 ms for 256 × 256.
void sample_region(const RgbImage& image, const ImageRegion& region, Border border, int side,
                   float level, float offset, std::span<float> out);

}  // namespace foretrack
