// SPDX-License-Identifier: Apache-2.0
// How tall somebody is, from one image of them on their feet.
#pragma once

#include <array>
#include <optional>

#include "core/common/target.hpp"

namespace foretrack {

/// The ray through the nearer heel meets the ground where they stand; so far away, the ears are as
/// high as the image shows. No height is assumed. `ground_m`: of the ground there, world. None:
/// heels or ears are below min_visibility, the camera is no higher than the ground or looks at the
/// heels too flatly, or it is nobody's height. An image alone is wrong by some 4 cm at 4 m, by more
/// for who bends or sits. Cost: below a microsecond.
std::optional<double> measure_height(const std::array<Landmark, kLandmarkCount>& landmarks,
                                     const CameraModel& camera, const Pose& T_world_camera,
                                     double ground_m, double min_visibility);

}  // namespace foretrack
