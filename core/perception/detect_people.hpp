// SPDX-License-Identifier: Apache-2.0
// Where there are people in an image: BlazePose's detector.
#pragma once

#include <array>
#include <vector>

#include "core/common/image.hpp"
#include "core/network/inference.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

/// One person whom the detector sees. Image points are in pixels of the whole image.
struct Detection {
  double score = 0.0;  ///< probability that it is a person, 0 to 1
  Vec2 box_min_px = Vec2::Zero(), box_max_px = Vec2::Zero();  ///< of the face
  /// [0]: middle of the hips. [1]: the point that is half a body away from it, towards the head, so
  /// that both say the size and the angle of the whole body. [2], [3]: middle of the shoulders, and
  /// the same for the upper body.
  std::array<Vec2, 4> points_px{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  /// Middle of the torso: halfway between hips and shoulders.
  Vec2 torso_px() const { return 0.5 * (points_px[0] + points_px[2]); }
};

/// Everybody in a window of the image whose score is at least min_score, the most certain first.
/// The window is brought to 224 × 224 pixels. Boxes that overlap (intersection over union above
/// 0.3) are one person: the mean of them, weighted by their scores (as in BlazeFace, Bazarevsky et
/// al. 2019). Cost: about 11 ms, all of it the network's.
std::vector<Detection> detect_people(const RgbImage& image, const ImageRegion& window,
                                     Inference& detector, double min_score);

/// The least square that holds the image; its middle is that of the image.
ImageRegion whole_of(const RgbImage& image);

/// The square around a body, 1.25 times as large as the body, turned so that the body is upright in
/// it. `middle_px`: of the body. `end_px`: half a body away from it, towards the head.
ImageRegion region_of_body(const Vec2& middle_px, const Vec2& end_px);
/// The square of the image that the pose network looks at for this person.
ImageRegion region_of_body(const Detection& person);

}  // namespace foretrack
