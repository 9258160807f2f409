// SPDX-License-Identifier: Apache-2.0
// What the person who is followed wears: tells them from somebody else who is as near.
#pragma once

#include <optional>

#include "core/common/appearance.hpp"
#include "core/common/image.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// What the person in this pose wears in this image, by 8 × 8 samples of the torso. None: less than
/// a quarter of a half's samples is inside the image. Cost: 2 µs.
std::optional<Appearance> appearance_of(const RgbImage& image, const PersonPose& person);

/// How much the torso's colour differs from a described one (red, green, blue, 0 to 255): mostly by
/// its tint, which the brightness of the light does not change. 0 for the same, about 1 for red and
/// grey.
double difference_from_color(const Appearance& seen, const Vec3& rgb);

}  // namespace foretrack
