// SPDX-License-Identifier: Apache-2.0
// A pose whose torso is a square, and an image in which it has a colour.
#pragma once

#include "core/common/image.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack::testing {

/// The torso's sides are a fifth of the size; the left shoulder is to the right in the image.
inline PersonPose pose_at(const Vec2& torso_px, double size_px) {
  PersonPose pose;
  const auto put = [&](TorsoJoint joint, double x, double y) {
    pose.landmarks[joint].image_px = torso_px + size_px * Vec2(x, y);
  };
  put(kLeftShoulder, 0.1, -0.1);
  put(kRightShoulder, -0.1, -0.1);
  put(kLeftHip, 0.1, 0.1);
  put(kRightHip, -0.1, 0.1);
  pose.tracked = {torso_px, size_px, 0.0};
  return pose;
}

using Rgb = std::array<std::uint8_t, 3>;

/// The upper and the lower half of an image, divided at a row.
inline RgbImage two_colours(int width_px, int height_px, int row, const Rgb& upper,
                            const Rgb& lower) {
  RgbImage image{width_px, height_px, {}};
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const Rgb& c = y < row ? upper : lower;
      image.rgb.insert(image.rgb.end(), c.begin(), c.end());
    }
  return image;
}

}  // namespace foretrack::testing
