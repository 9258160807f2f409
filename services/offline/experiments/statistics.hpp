// SPDX-License-Identifier: Apache-2.0
// Whether two methods differ on the same seeds.
#pragma once

#include <cstdint>
#include <span>

#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// McNemar's exact test on paired outcomes: the two-sided probability of a split as uneven as this
/// one, or more, if neither method were better. only_a: successes of the first alone. 1 without
/// any. Cost: linear in the sum.
double mcnemar_p(int only_a, int only_b);

/// The mean of the values and the 95 % interval of it by a seeded percentile bootstrap. Zeros
/// without values.
struct MeanInterval {
  double mean = 0.0, low = 0.0, high = 0.0;
  bool excludes_zero() const { return low > 0.0 || high < 0.0; }
};
MeanInterval bootstrap_mean(std::span<const double> values, std::uint64_t seed,
                            int resamples = 2000);

}  // namespace foretrack
