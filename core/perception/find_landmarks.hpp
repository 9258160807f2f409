// SPDX-License-Identifier: Apache-2.0
// The landmarks of the person in a region of an image: BlazePose's second network.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/common/target.hpp"
#include "core/network/inference.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

/// The height that the network takes everybody to have. Two ways lead to it. Added up bone by bone,
/// its people's ears are 1.41 m above their ankles; that is 0.887 of a person's height (Drillis and
/// Contini 1966), so of 1.59 m. Rendered people, whose range is known, come out at their true range
/// with 1.62 m (bench/camera); this is the one that is used.
inline constexpr double kNetworkHeight_m = 1.62;

/// A person as the network sees one.
///
/// image_px of a landmark is in pixels of the whole image. body_m is in metres from the middle of
/// the hips, for a person of kNetworkHeight_m. Its axes are those of a camera that looks at the
/// middle of the region, not those of the real camera: to_observation() turns them.
struct PersonPose {
  std::array<Landmark, kLandmarkCount> landmarks{};
  double score = 0.0;   ///< probability that there is a person in the region, 0 to 1
  ImageRegion region;   ///< where the landmarks were looked for
  ImageRegion tracked;  ///< where to look for them in the next image
  /// The mean of both shoulders and both hips in the image.
  Vec2 torso_px() const;
};

/// Looks for one person's landmarks in a region of an image (BlazePose, Bazarevsky et al. 2020).
/// Image points are refined by the network's heat maps: each moves to the centre of the heat within
/// three cells around it. None: the score is below min_score, the region is smaller than 4 pixels
/// or not finite, or the network's numbers are not finite. Cost: that of the network and 1.5 ms.
std::optional<PersonPose> find_landmarks(const RgbImage& image, const ImageRegion& region,
                                         Inference& network, double min_score);

}  // namespace foretrack
