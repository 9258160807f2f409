// SPDX-License-Identifier: Apache-2.0
// The quintic between two states, in normalised time α = t / T: p(α) = h(α) · Q with
// Q = (p0, T v0, T² a0, p1, T v1, T² a1).
#pragma once

#include <array>

#include "core/planning/motion/flight_limits.hpp"

namespace foretrack {

using HermiteRow = std::array<double, 6>;
/// Rows (p0, T v0, T² a0, p1, T v1, T² a1), columns x, y, z.
using ScaledEnds = Eigen::Matrix<double, 6, 3>;

/// kHermite[r][j]: factor of α^j in the basis polynomial of the r-th end value.
inline constexpr std::array<HermiteRow, 6> kHermite = {{{1, 0, 0, -10, 15, -6},
                                                        {0, 1, 0, -6, 8, -3},
                                                        {0, 0, 0.5, -1.5, 1.5, -0.5},
                                                        {0, 0, 0, 10, -15, 6},
                                                        {0, 0, 0, -4, 7, -3},
                                                        {0, 0, 0, 0.5, -1, 0.5}}};

/// The order-th derivative by α of the six basis polynomials at α.
constexpr HermiteRow hermite(double alpha, int order) {
  HermiteRow row{};
  for (int r = 0; r < 6; ++r) {
    double value = 0.0;
    for (int j = 5; j >= order; --j) {
      double factor = kHermite[r][j];
      for (int m = 0; m < order; ++m) factor *= j - m;
      value = value * alpha + factor;
    }
    row[r] = value;
  }
  return row;
}

/// The least-jerk motion between two states in a given duration.
inline QuinticPiece quintic_between(const BoundaryState& from, const BoundaryState& to,
                                    double duration_s) {
  const double t = duration_s;
  ScaledEnds ends;
  ends << from.position.transpose(), t * from.velocity.transpose(),
      t * t * from.acceleration.transpose(), to.position.transpose(), t * to.velocity.transpose(),
      t * t * to.acceleration.transpose();
  QuinticPiece piece;
  piece.duration_s = duration_s;
  double power = 1.0;
  for (int j = 0; j < 6; ++j, power /= t)
    for (int r = 0; r < 6; ++r) piece.coefficients.row(j) += power * kHermite[r][j] * ends.row(r);
  return piece;
}

}  // namespace foretrack
