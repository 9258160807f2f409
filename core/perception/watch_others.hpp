// SPDX-License-Identifier: Apache-2.0
// Who else is near the person who is followed.
#pragma once

#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// After perceive_image() on the same image: looks around the chosen person for others (by the
/// detector, once in watch_period_s, to the left and to the right in turns, as its input is small),
/// and follows the nearest of them in its own region, so that
/// the next image's pose can be told from theirs. Cost: the landmark network once more while
/// somebody is near, and the detector in one of four images.
void watch_others(PoseState& state, const RgbImage& image, double stamp_s, PoseNetwork& network,
                  const PerceptionParams& params);

}  // namespace foretrack
