// SPDX-License-Identifier: Apache-2.0
#include "core/perception/undistort_person.hpp"

namespace foretrack {

void undistort(PersonPose& person, const CameraModel& camera, const Lens& lens) {
  if (!lens.distorts()) return;
  for (Landmark& landmark : person.landmarks) {
    const auto straight = undistort(landmark.image_px, camera, lens);
    if (straight)
      landmark.image_px = *straight;
    else
      landmark.visibility = 0.0;
  }
}

}  // namespace foretrack
