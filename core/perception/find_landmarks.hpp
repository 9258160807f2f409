// SPDX-License-Identifier: Apache-2.0
// The landmarks of the person in a region of an image: BlazePose's second network.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/common/target.hpp"
#include "core/network/inference.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

/// A person as the network sees one: landmarks in the pixels of the whole image, and in metres from
/// the middle of the hips with the axes of a camera that looks at the middle of the region, for a
/// person of kNetworkHeight_m: everybody's ears are 1.41 m above their ankles, bones added up,
/// which is 0.887 of the height (Drillis and Contini 1966) of 1.59 m; by the range of rendered
/// people (bench/camera) it is 1.62 m.
struct PersonPose {
  std::array<Landmark, kLandmarkCount> landmarks{};
  double score = 0.0;   // [0, 1]: that there is a person in the region
  ImageRegion region;   // that the landmarks were looked for in
  ImageRegion tracked;  // where to look for them in the next image
  Vec2 torso_px() const;
};
inline constexpr double kNetworkHeight_m = 1.62;

/// None: the score is below min_score, or the region is none. Cost: that of the network and 1.5 ms.
std::optional<PersonPose> find_landmarks(const RgbImage& image, const ImageRegion& region,
                                         Inference& network, double min_score);

}  // namespace foretrack
