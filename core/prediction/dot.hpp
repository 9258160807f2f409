// SPDX-License-Identifier: Apache-2.0
// The scalar product of rows of fitted weights with features.
#pragma once

#include <span>

namespace foretrack {

/// Precondition: as many of both.
inline double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace foretrack
