// SPDX-License-Identifier: Apache-2.0
// Whether what was given a probability came true as often: calibration.
#pragma once

#include <utility>
#include <vector>

namespace foretrack {

/// What was said with about one probability, and how often it came true.
struct ReliabilityBin {
  double probability = 0.0;  ///< mean of what was said
  double frequency = 0.0;    ///< share that came true
  int count = 0;             ///< pairs in the bin
};

/// Bins of equal mass over pairs of (probability, came true), sorted by probability: each has as
/// many pairs as the others, or one more. Empty bins are left out. Cost: of sorting the pairs.
std::vector<ReliabilityBin> reliability_bins(std::vector<std::pair<double, bool>> pairs, int bins);

/// The mean gap |probability − frequency| of the bins, each weighed by its count; 0 without any
/// (Naeini, Cooper and Hauskrecht 2015).
double expected_calibration_error(const std::vector<ReliabilityBin>& bins);

}  // namespace foretrack
