// SPDX-License-Identifier: Apache-2.0
// Maximum likelihood of the multinomial logistic model of core/prediction/calibrate.hpp.
#pragma once

#include "bench/prediction/head_weights.hpp"

namespace foretrack::bench {

/// Newton's method with a ridge penalty (per window) on all weights but each head's first, of the
/// constant; converges because the problem is convex. No hidden units.
ModelWeights fit_softmax(const std::vector<Window>& windows, const Heads& heads, double ridge);

}  // namespace foretrack::bench
