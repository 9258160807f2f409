// SPDX-License-Identifier: Apache-2.0
// Maximum likelihood of the multinomial logistic model of core/prediction/calibrate.hpp.
#pragma once

#include "bench/prediction/windows.hpp"

namespace foretrack::bench {

/// Newton's method with a ridge penalty (per window) on all weights but the two biases; converges
/// because the problem is convex.
CalibrationWeights fit_softmax(const std::vector<Window>& windows, double ridge);

double mean_log_loss(const std::vector<Window>& windows, const CalibrationWeights& weights);

}  // namespace foretrack::bench
