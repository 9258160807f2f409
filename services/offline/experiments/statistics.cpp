// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/common/random.hpp"

namespace foretrack {

double mcnemar_p(int only_a, int only_b) {
  const int n = only_a + only_b, k = std::min(only_a, only_b);
  if (n == 0) return 1.0;
  double sum = 0.0;  // P(X ≤ k), X binomial with n trials of 1/2
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) -
                    n * std::log(2.0));
  return std::min(1.0, 2.0 * sum);
}

MeanInterval bootstrap_mean(std::span<const double> values, std::uint64_t seed, int resamples) {
  if (values.empty()) return {};
  const auto mean_of = [&](auto&& pick) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[pick(i)];
    return sum / static_cast<double>(values.size());
  };
  Random random(seed);
  const int last = static_cast<int>(values.size()) - 1;
  std::vector<double> means;
  for (int i = 0; i < resamples; ++i)
    means.push_back(mean_of([&](std::size_t) { return random.integer(0, last); }));
  std::sort(means.begin(), means.end());
  const auto quantile = [&](double q) {
    return means[static_cast<std::size_t>(q * static_cast<double>(means.size() - 1))];
  };
  return {mean_of([](std::size_t i) { return i; }), quantile(0.025), quantile(0.975)};
}

}  // namespace foretrack
