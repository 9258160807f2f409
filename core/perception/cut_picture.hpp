// SPDX-License-Identifier: Apache-2.0
// A small picture of one person, cut from the camera's image.
#pragma once

#include "core/common/geometry.hpp"
#include "core/common/image.hpp"

namespace foretrack {

/// What is in the box and a little around it, as far as it is in the image, no side longer than
/// `most_px`. Empty if nothing of it is. Each pixel is the mean of those that it stands for. Cost:
/// 1 ms for a person who fills a 640 × 480 image.
RgbImage cut_picture(const RgbImage& image, const Vec2& low_px, const Vec2& high_px, int most_px);

}  // namespace foretrack
