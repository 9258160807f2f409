// SPDX-License-Identifier: Apache-2.0
// Adds hidden units to a fitted logistic model.
#pragma once

#include "bench/prediction/head_weights.hpp"

namespace foretrack::bench {

/// Stochastic gradient descent (Adam) on the log-loss from the given weights, seeded: the same
/// windows give the same weights.
ModelWeights fit_hidden(const std::vector<Window>& windows, const Heads& heads,
                        const ModelWeights& start);

}  // namespace foretrack::bench
