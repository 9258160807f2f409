// SPDX-License-Identifier: Apache-2.0
// What somebody wears, as numbers that can be compared.
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// The mean colours of the upper and of the lower half of the torso.
///
/// Each half has three numbers: log(red / green), log(blue / green) and 0.4 · log(brightness). The
/// brightness of the light does not change the first two, and the third one little.
struct Appearance {
  Eigen::Matrix<double, 6, 1> colors = Eigen::Matrix<double, 6, 1>::Zero();
};

/// How much two appearances differ: 0 for the same, about 0.1 for one person from image to image,
/// about 1 for red and grey clothes.
inline double difference(const Appearance& a, const Appearance& b) {
  return (a.colors - b.colors).norm();
}

/// Moves what is known by a share (0 to 1) of its difference from what was seen.
inline void learn(Appearance& known, const Appearance& seen, double share) {
  known.colors += share * (seen.colors - known.colors);
}

}  // namespace foretrack
