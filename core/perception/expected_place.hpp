// SPDX-License-Identifier: Apache-2.0
// Where the person who is followed should be in an image.
#pragma once

#include <optional>

#include "core/perception/perceive.hpp"
#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// By the filter's estimate at the image's stamp and the vehicle's pose then; the gate is three
/// standard deviations and half a body. None: nobody is tracked, or no pose of the vehicle is
/// known. Behind the camera the place is far outside the image.
std::optional<ExpectedPlace> expected_place(const PerceptionState& state,
                                            const VehicleHistory& vehicle,
                                            const CameraModel& camera, double stamp_s,
                                            const PerceptionParams& params);

}  // namespace foretrack
