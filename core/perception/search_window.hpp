// SPDX-License-Identifier: Apache-2.0
// Which part of an image the detector looks at next.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/perception/image_region.hpp"

namespace foretrack {

/// Where the chosen person should be in an image, e.g. as the filter predicts.
struct ExpectedPlace {
  Vec2 torso_px = Vec2::Zero();
  double gate_px = 0.0;   ///< who is farther away from torso_px is somebody else
  double body_px = 0.0;   ///< height of the body there; 0: not known
  bool refused = false;   ///< the last pose was not there: the filter did not take it
  double sigma_px = 0.0;  ///< standard deviation of torso_px
};

/// The part of the image that the detector looks at in its look-th look for a person. Its input is
/// so small that people far away are found in a part of the image only.
///
/// Look 0 is at the area where the person may be: the gate with a body around it, or the whole
/// image. Looks 1 to 9 are at nine overlapping parts of that area with half its side, the middle
/// first. Then it begins anew. Parts without image are left out. An area that is not much larger
/// than the expected body has no parts. None: the person cannot be in the image.
std::optional<ImageRegion> search_window(const RgbImage& image,
                                         const std::optional<ExpectedPlace>& place, int look);

/// The whole image and its nine parts: no area has more windows.
inline constexpr int kMostWindows = 10;

}  // namespace foretrack
