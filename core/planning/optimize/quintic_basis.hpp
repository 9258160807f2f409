// SPDX-License-Identifier: Apache-2.0
// The quintic between two states, in normalised time α = t / T: p(α) = h(α) · Q with
// Q = (p0, T v0, T² a0, p1, T v1, T² a1).
#pragma once

#include <array>

#include "core/common/geometry.hpp"

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

}  // namespace foretrack
