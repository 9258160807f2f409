// SPDX-License-Identifier: Apache-2.0
// To go on as before: what is expected while nothing speaks for another intention.
#pragma once

#include "core/prediction/intentions/intention_row.hpp"

namespace foretrack::intentions {

/// Its logit is 0: those of the others are measured against it.
inline constexpr IntentionRow kForward{
    .name = "forward",
    .color_rgb = 0x56b4e9,
    .potential =
        [](const IntentionEvidence& e) {  // eq. 10
          return -e.params.k4_forward_potential * e.strongest_potential +
                 e.params.b1_forward_potential;
        },
    .observation =
        [](const IntentionEvidence& e) {
          return -e.params.k5_forward_observation * e.strongest_observation +
                 e.params.b2_forward_observation;
        },
    .motion_model = [](const PredictionParams&) { return MotionModel::constant_velocity(); },
    .noise_m2_s3 = 0.05,
};

}  // namespace foretrack::intentions
