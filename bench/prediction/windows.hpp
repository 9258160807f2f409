// SPDX-License-Identifier: Apache-2.0
// Labelled moments of an episode, with what prediction knew and said.
#pragma once

#include <vector>

#include "bench/prediction/episodes.hpp"
#include "core/prediction/calibrate.hpp"
#include "core/prediction/predict.hpp"

namespace foretrack::bench {

struct Window {
  IntentionFeatures features;
  Intention label = Intention::kForward;
};

/// One window every 0.12 s.
std::vector<Window> windows_of(const Episode& episode, const PredictionParams& params);

}  // namespace foretrack::bench
