// SPDX-License-Identifier: Apache-2.0
// How far away a depth image says that the torso is.
#pragma once

#include <optional>

#include "core/common/camera.hpp"
#include "core/common/target.hpp"

namespace foretrack {

/// Median depth (z) of the torso's surface, between shoulders and hips. The depth camera is where
/// the colour camera is; its size and angles may be others. None: too few returns there.
std::optional<double> torso_surface_depth_m(const TargetObservation& observation,
                                            const DepthImage& depth);

}  // namespace foretrack
