// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/deviation_bound.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kShare = 0.99;
constexpr double kStep_m = 0.02;  // by which one greater deviation widens the bound
constexpr double kLeast_m = 0.03, kMost_m = 0.30;
constexpr double kFirstAtRest_m = 0.05, kFirstBySpeed_s = 0.05;  // before anything is measured
constexpr double kHard_m_s2 = 2.0;

}  // namespace

DeviationBound::DeviationBound() {
  for (int i = 0; i < kSpeeds; ++i)
    for (int j = 0; j < kAccelerations; ++j)
      bounds_m_[static_cast<std::size_t>(i * kAccelerations + j)] =
          kFirstAtRest_m + kFirstBySpeed_s * i;
}

std::size_t DeviationBound::bin(double speed_m_s, double acceleration_m_s2) {
  const int i = std::clamp(static_cast<int>(std::lround(speed_m_s)), 0, kSpeeds - 1);
  const int j = acceleration_m_s2 > kHard_m_s2 ? 1 : 0;
  return static_cast<std::size_t>(i * kAccelerations + j);
}

// A quantile by stochastic approximation (Robbins and Monro 1951): at rest where a hundredth of the
// deviations is greater.
void DeviationBound::add(double speed_m_s, double acceleration_m_s2, double deviation_m) {
  if (!std::isfinite(deviation_m)) return;
  double& bound_m = bounds_m_[bin(speed_m_s, acceleration_m_s2)];
  bound_m += kStep_m * (deviation_m > bound_m ? kShare : kShare - 1.0);
  bound_m = std::clamp(bound_m, kLeast_m, kMost_m);
}

double DeviationBound::bound_m(double speed_m_s, double acceleration_m_s2) const {
  return bounds_m_[bin(speed_m_s, acceleration_m_s2)];
}

}  // namespace foretrack
