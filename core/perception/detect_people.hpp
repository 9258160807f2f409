// SPDX-License-Identifier: Apache-2.0
// Where there are people in an image: BlazePose's detector.
#pragma once

#include <array>
#include <vector>

#include "core/common/image.hpp"
#include "core/network/inference.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

struct Detection {
  double score = 0.0;
  Vec2 box_min_px = Vec2::Zero(), box_max_px = Vec2::Zero();  // of the face
  /// Middle of the hips, a point that says size and angle of the whole body; the same of its upper
  /// part.
  std::array<Vec2, 4> points_px{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  /// Middle of the torso: halfway between hips and shoulders.
  Vec2 torso_px() const { return 0.5 * (points_px[0] + points_px[2]); }
};

/// Everybody, the most certain first; scores at least min_score. Boxes that overlap (intersection
/// over union above 0.3) are averaged by their scores. `window`: what is looked at, 224 × 224
/// pixels of it. Cost: about 11 ms.
std::vector<Detection> detect_people(const RgbImage& image, const ImageRegion& window,
                                     Inference& detector, double min_score);

/// The smallest square that holds the image.
ImageRegion whole_of(const RgbImage& image);

/// The square around a body from its middle to a point that is half its size away.
ImageRegion region_of_body(const Vec2& middle_px, const Vec2& end_px);
ImageRegion region_of_body(const Detection& person);

}  // namespace foretrack
