// SPDX-License-Identifier: Apache-2.0
// Unconstrained variables ↔ piece durations that are positive and together last at least a given
// time (paper §V.B: the trajectory must reach the horizon).
#pragma once

#include <span>

namespace foretrack {

/// Durations from variables that may have any value. The variables are τ_1, τ_2, …, then σ.
/// - T_i = S · w(τ_i) / Σ w(τ_j)
/// - S = min_total_s + kExtraScale_s · w(σ)
/// - w(x) = (x + √(x² + 4)) / 2: smooth, positive, increasing, and w(−x) = 1 / w(x).
/// Square roots only: the same bits on every machine.
struct DurationMap {
  double min_total_s = 0.0;

  void to_durations(std::span<const double> variables, std::span<double> durations_s) const;
  /// The inverse, with Σ w = number of pieces; totals below the least are raised a little above it.
  void to_variables(std::span<const double> durations_s, std::span<double> variables) const;
  /// Gradient by variables from the gradient by durations.
  void pull_back(std::span<const double> variables, std::span<const double> by_durations,
                 std::span<double> by_variables) const;
};

}  // namespace foretrack
