// SPDX-License-Identifier: Apache-2.0
// What the person who is followed wears: tells them from somebody else who is as near.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// Mean colour of the upper and the lower half of the torso: two logarithms of ratios, which the
/// brightness of the light does not change, and a part of the logarithm of the brightness.
struct Appearance {
  Eigen::Matrix<double, 6, 1> colors = Eigen::Matrix<double, 6, 1>::Zero();
};

/// None: the torso is outside the image, or seen from its edge. Cost: 2 µs.
std::optional<Appearance> appearance_of(const RgbImage& image, const PersonPose& person);

/// 0: the same; about 0.1 from image to image, 1 for red and grey.
double difference(const Appearance& a, const Appearance& b);

/// Moves towards what was seen.
void learn(Appearance& known, const Appearance& seen, double share);

}  // namespace foretrack
