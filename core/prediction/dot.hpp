// SPDX-License-Identifier: Apache-2.0
// The scalar product of rows of fitted weights with features.
#pragma once

#include <array>
#include <cstddef>

namespace foretrack {

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace foretrack
