// SPDX-License-Identifier: Apache-2.0
// What the person who is followed wears: tells them from somebody else who is as near.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// The mean colours of the upper and of the lower half of the torso.
///
/// Each half has three numbers: log(red / green), log(blue / green) and 0.4 · log(brightness). The
/// brightness of the light does not change the first two, and the third one little.
struct Appearance {
  Eigen::Matrix<double, 6, 1> colors = Eigen::Matrix<double, 6, 1>::Zero();
};

/// What the person in this pose wears in this image, by 8 × 8 samples of the torso. None: less than
/// a quarter of a half's samples is inside the image. Cost: 2 µs.
std::optional<Appearance> appearance_of(const RgbImage& image, const PersonPose& person);

/// How much two appearances differ: 0 for the same, about 0.1 for one person from image to image,
/// about 1 for red and grey clothes.
double difference(const Appearance& a, const Appearance& b);

/// Moves what is known by a share (0 to 1) of its difference from what was seen.
void learn(Appearance& known, const Appearance& seen, double share);

}  // namespace foretrack
