// SPDX-License-Identifier: Apache-2.0
// How far away a depth image says that the torso is.
#pragma once

#include <optional>

#include "core/common/camera.hpp"
#include "core/common/target.hpp"

namespace foretrack {

/// The depth of the torso's surface along the optical axis: the median of 9 × 9 samples between
/// shoulders and hips. The depth camera must be where the colour camera is and look the same way;
/// its size and its angles of view may be others. None: less than a quarter of the samples has a
/// return between 0.2 m and 30 m. Cost: 1 µs.
std::optional<double> torso_surface_depth_m(const TargetObservation& observation,
                                            const DepthImage& depth);

}  // namespace foretrack
