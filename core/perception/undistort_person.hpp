// SPDX-License-Identifier: Apache-2.0
// A person's image points as a camera without distortion would have them.
#pragma once

#include "core/common/lens.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// Undistorts the image points of all landmarks. Those that cannot be undistorted become invisible
/// (visibility 0).
void undistort(PersonPose& person, const CameraModel& camera, const Lens& lens);

}  // namespace foretrack
