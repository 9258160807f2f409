// SPDX-License-Identifier: Apache-2.0
// Adds hidden units to a fitted logistic model.
#pragma once

#include "bench/prediction/windows.hpp"

namespace foretrack::bench {

/// Stochastic gradient descent (Adam) on the log-loss from the given weights, seeded: the same
/// windows give the same weights.
CalibrationWeights fit_hidden(const std::vector<Window>& windows, const CalibrationWeights& start);

}  // namespace foretrack::bench
