// SPDX-License-Identifier: Apache-2.0
// What somebody wears and how tall they are, as numbers that can be compared.
#pragma once

#include <cmath>
#include <limits>

#include "core/common/geometry.hpp"

namespace foretrack {

/// The mean colours of the upper and of the lower half of the torso, and of thighs and shanks where
/// they were seen.
///
/// Each part has three numbers: log(red / green), log(blue / green) and 0.4 · log(brightness). The
/// brightness of the light does not change the first two, and the third one little.
struct Appearance {
  Eigen::Matrix<double, 6, 1> colors = Eigen::Matrix<double, 6, 1>::Zero();  ///< of the torso
  Eigen::Matrix<double, 6, 1> legs = Eigen::Matrix<double, 6, 1>::Zero();    ///< if legs_seen
  bool legs_seen = false;
  double height_m = std::numeric_limits<double>::quiet_NaN();  ///< of the person; NaN: not known
};

/// How much two torsos differ in one light: 0 for the same, about 0.1 for one person from image to
/// image, about 1 for red and grey clothes.
inline double difference(const Appearance& a, const Appearance& b) {
  return (a.colors - b.colors).norm();
}

/// How much two appearances differ, in whatever light and exposure: by the colours of torso and
/// legs, by what of them is brighter than what, little by how bright all is, and by height. Legs
/// and heights count if both were seen. About 0.2 for one person from any two sides, 0.3 and more
/// for others (measured on rendered people: `foretrack bench identity`).
inline double lasting_difference(const Appearance& a, const Appearance& b) {
  constexpr double kContrast = 0.5, kBrightness = 0.1;
  constexpr double kSameHeight_m = 0.06, kHeight_per_m = 2.0;
  const Eigen::Matrix<double, 6, 1> torso = a.colors - b.colors;
  double sum = torso.head<2>().squaredNorm() + torso.segment<2>(3).squaredNorm();
  const auto add = [&sum](double value) { sum += value * value; };
  add(kContrast * (torso[2] - torso[5]));
  add(kBrightness * (torso[2] + torso[5]));
  const double taller_m = std::abs(a.height_m - b.height_m);
  if (taller_m > kSameHeight_m) add(kHeight_per_m * (taller_m - kSameHeight_m));  // not of NaN
  if (!a.legs_seen || !b.legs_seen) return std::sqrt(sum);
  const Eigen::Matrix<double, 6, 1> legs = a.legs - b.legs;
  sum += legs.head<2>().squaredNorm() + legs.segment<2>(3).squaredNorm();
  add(kContrast * (torso[5] - legs[2]));
  add(kContrast * (legs[2] - legs[5]));
  return std::sqrt(sum);
}

/// Moves what is known by a share (0 to 1) of its difference from what was seen.
inline void learn(Appearance& known, const Appearance& seen, double share) {
  known.colors += share * (seen.colors - known.colors);
  if (!std::isnan(seen.height_m))
    known.height_m = std::isnan(known.height_m)
                         ? seen.height_m
                         : known.height_m + share * (seen.height_m - known.height_m);
  if (!seen.legs_seen) return;
  known.legs += (known.legs_seen ? share : 1.0) * (seen.legs - known.legs);
  known.legs_seen = true;
}

}  // namespace foretrack
