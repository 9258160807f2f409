// SPDX-License-Identifier: Apache-2.0
#include "core/scores/reliability.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {

std::vector<ReliabilityBin> reliability_bins(std::vector<std::pair<double, bool>> pairs, int bins) {
  // Moments of equal probability stay in their order: sorted by outcome they would fill whole bins.
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ReliabilityBin> result;
  const std::size_t n = pairs.size();
  for (int b = 0; b < bins; ++b) {
    ReliabilityBin bin;
    for (std::size_t i = n * b / bins; i < n * (b + 1) / bins; ++i) {
      bin.probability += pairs[i].first;
      bin.frequency += pairs[i].second ? 1.0 : 0.0;
      ++bin.count;
    }
    if (bin.count == 0) continue;
    bin.probability /= bin.count;
    bin.frequency /= bin.count;
    result.push_back(bin);
  }
  return result;
}

double expected_calibration_error(const std::vector<ReliabilityBin>& bins) {
  double sum = 0.0;
  int count = 0;
  for (const auto& bin : bins) {
    sum += bin.count * std::abs(bin.probability - bin.frequency);
    count += bin.count;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace foretrack
