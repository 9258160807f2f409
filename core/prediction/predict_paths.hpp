// SPDX-License-Identifier: Apache-2.0
// One path per intention, with its probability and covariance.
#pragma once

#include "core/prediction/predict.hpp"

namespace foretrack {

/// Drops the paths, but keeps their memory.
void clear_prediction(PredictionState& state, double stamp_s, PredictionStatus status);

/// Fills state.result.prediction from state.result.intention.
void predict_paths(PredictionState& state, const TargetState& target, const MotionCues& motion,
                   const GridMap& map, const PredictionParams& params,
                   IntentionTable table = kIntentions);

}  // namespace foretrack
