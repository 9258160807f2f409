// SPDX-License-Identifier: Apache-2.0
// Exact extrema of polynomials of low degree: real roots in an interval, and bounds.
#pragma once

#include <array>
#include <span>

#include "core/common/trajectory.hpp"

namespace foretrack {

inline constexpr int kMaxDegree = 8;

/// Σ c_j x^j.
struct Polynomial {
  int degree = 0;
  std::array<double, kMaxDegree + 1> c{};

  double at(double x) const {
    double value = c[degree];
    for (int j = degree - 1; j >= 0; --j) value = value * x + c[j];
    return value;
  }
  Polynomial derivative() const;
};

/// Ascending.
struct Roots {
  int count = 0;
  std::array<double, kMaxDegree> at{};
};

/// Where the polynomial changes its sign in (0, 1], to rounding: between neighbouring roots of its
/// derivative it is monotonic, so each sign change there is one root. Cost: about 1 µs at degree 7.
Roots sign_changes(const Polynomial& p);

/// At least the maximum over [0, 1]: the greatest Bernstein coefficient.
double upper_bound(const Polynomial& p);

/// The greatest value of a norm, and when.
struct Peak {
  double value = 0.0;
  double time_s = 0.0;
};

/// Maximum of the norm of the order-th derivative over consecutive pieces, from the roots of its
/// square's derivative; pieces whose bound stays below what was found already are passed over.
/// order: 1 (speed) to 3.
Peak peak_norm(std::span<const QuinticPiece> pieces, int order);

}  // namespace foretrack
