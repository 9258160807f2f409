// SPDX-License-Identifier: Apache-2.0
// Fits the network of core/prediction/short_term_motion.hpp.
#pragma once

#include <vector>

#include "core/prediction/short_term_motion.hpp"

namespace foretrack::bench {

struct ShortTermSample {
  ShortTermFeatures features;
  ShortTermErrors errors;
};

/// Least squares, each output counted in its standard deviations, by stochastic gradient descent
/// (Adam), seeded: the same samples give the same weights.
ShortTermWeights fit_network(const std::vector<ShortTermSample>& samples);

/// Root mean squares of the outputs' errors [m, m/s, m, m/s]; before, if weights are zero.
std::array<double, ShortTermWeights::kOutputs> errors_left(
    const std::vector<ShortTermSample>& samples, const ShortTermWeights& weights);

}  // namespace foretrack::bench
