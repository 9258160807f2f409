// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/duration_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace foretrack {
namespace {

constexpr double kExtraScale_s = 0.2;
constexpr double kExtraMin_s = 0.05;  // where a first guess at the bound begins

double positive(double x) {
  const double root = std::sqrt(x * x + 4.0);
  // Without cancellation on the negative side.
  return x >= 0.0 ? 0.5 * (x + root) : 2.0 / (root - x);
}
double positive_slope(double x) {
  return positive(x) / std::sqrt(x * x + 4.0);
}
double positive_inverse(double w) {
  return w - 1.0 / w;
}

double sum_of_positive(std::span<const double> variables) {
  double sum = 0.0;
  for (const double x : variables) sum += positive(x);
  return sum;
}

}  // namespace

void DurationMap::to_durations(std::span<const double> variables,
                               std::span<double> durations_s) const {
  const std::size_t pieces = durations_s.size();
  const double total = min_total_s + kExtraScale_s * positive(variables[pieces]);
  const double scale = total / sum_of_positive(variables.first(pieces));
  for (std::size_t i = 0; i < pieces; ++i) durations_s[i] = scale * positive(variables[i]);
}

void DurationMap::to_variables(std::span<const double> durations_s,
                               std::span<double> variables) const {
  const std::size_t pieces = durations_s.size();
  const double total = std::accumulate(durations_s.begin(), durations_s.end(), 0.0);
  const double mean = total / static_cast<double>(pieces);
  for (std::size_t i = 0; i < pieces; ++i) variables[i] = positive_inverse(durations_s[i] / mean);
  variables[pieces] = positive_inverse(std::max(total - min_total_s, kExtraMin_s) / kExtraScale_s);
}

void DurationMap::pull_back(std::span<const double> variables, std::span<const double> by_durations,
                            std::span<double> by_variables) const {
  const std::size_t pieces = by_durations.size();
  const double total = min_total_s + kExtraScale_s * positive(variables[pieces]);
  const double inverse_sum = 1.0 / sum_of_positive(variables.first(pieces));
  double by_total = 0.0;  // Σ ∂J/∂T_i · T_i / S
  for (std::size_t i = 0; i < pieces; ++i)
    by_total += by_durations[i] * positive(variables[i]) * inverse_sum;
  for (std::size_t i = 0; i < pieces; ++i)
    by_variables[i] =
        total * inverse_sum * positive_slope(variables[i]) * (by_durations[i] - by_total);
  by_variables[pieces] = by_total * kExtraScale_s * positive_slope(variables[pieces]);
}

}  // namespace foretrack
