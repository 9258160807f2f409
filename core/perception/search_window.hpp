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
  double gate_px = 0.0;   // farther away it is somebody else
  double body_px = 0.0;   // height of the body there; 0: not known
  bool refused = false;   // the last pose was not there: the filter did not take it
  double sigma_px = 0.0;  // of torso_px
};

/// The detector's input is small: people far away are only found in a part of the image. The first
/// look is at everywhere that the person may be (the gate, or the whole image); the next ones are
/// at nine overlapping parts of it with half its side, the middle first, those without image left
/// out; then it begins anew. An area that is not much larger than the expected body has no parts.
/// `look` counts from 0. None: the person may be nowhere in the image.
std::optional<ImageRegion> search_window(const RgbImage& image,
                                         const std::optional<ExpectedPlace>& place, int look);

/// All parts of the whole image.
inline constexpr int kMostWindows = 10;

}  // namespace foretrack
