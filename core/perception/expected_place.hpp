// SPDX-License-Identifier: Apache-2.0
// Where the person who is followed should be in an image.
#pragma once

#include <optional>

#include "core/perception/perceive.hpp"
#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// Where the filter and the vehicle's pose, both at the image's stamp, put the torso in the image.
/// The gate around it is three standard deviations of the estimate and half a metre of body. For a
/// person behind the camera the place is far outside the image and the gate is 0. None: nobody is
/// tracked, or the vehicle's pose at the stamp is not known. Cost: below 1 µs.
std::optional<ExpectedPlace> expected_place(const PerceptionState& state,
                                            const VehicleHistory& vehicle,
                                            const CameraModel& camera, double stamp_s,
                                            const PerceptionParams& params);

}  // namespace foretrack
