// SPDX-License-Identifier: Apache-2.0
// Who else is near the person who is followed.
#pragma once

#include <optional>
#include <vector>

#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// Keeps an eye on the other person who is nearest to the chosen one. Call it after
/// perceive_image() on the same image: in the next image, a pose can then be told from theirs.
///
/// Once in watch_period_s the detector looks beside the chosen person, to the left and to the right
/// by turns, because its input is small. Whoever is found there and is nearer than the other person
/// so far takes their place in state.other. In every image the other person is followed in a region
/// of their own. They are forgotten when they are far away or were not seen for 1.5 s.
///
/// Cost: the landmark network once more while somebody is near, and the detector once in
/// watch_period_s. Returns everybody else whom it, or perceive_image(), saw in this image.
std::vector<OtherPerson> watch_others(PoseState& state, const RgbImage& image, double stamp_s,
                                      PoseNetwork& network, const PerceptionParams& params);

}  // namespace foretrack
