// SPDX-License-Identifier: Apache-2.0
// From evidence to probabilities that mean what they say.
#pragma once

#include "core/prediction/intention_features.hpp"

namespace foretrack {

/// Of one intention's logit: a row of weights and, for what matters only together (an opening and a
/// wall ahead), a layer of hidden units.
template <int kFeatures>
struct LogitWeights {
  using Row = std::array<double, kFeatures>;
  static constexpr int kHidden = 8;
  Row row{};
  std::array<Row, kHidden> hidden{};
  std::array<double, kHidden> hidden_bias{};
  std::array<double, kHidden> hidden_gain{};
};

/// Of a multinomial logistic model: forward has the logit 0, both turns share their weights.
struct CalibrationWeights {
  LogitWeights<IntentionFeatures::kTurnCount> turn;
  LogitWeights<IntentionFeatures::kDecelerateCount> decelerate;
};

/// Written by bench/prediction's fit_intention, which also says there what it was fitted on.
const CalibrationWeights& calibration_weights(bool map_known, bool body_known);

/// Probabilities of the intentions; they sum to 1. Cost: about a microsecond.
std::array<double, kIntentionCount> probabilities(const IntentionFeatures& features,
                                                  const CalibrationWeights& weights);

/// Fills the probabilities of the beliefs from their scores and the evidence.
void calibrate(const MotionCues& motion, const Surroundings& surroundings, bool map_known,
               IntentionAssessment& assessment);

}  // namespace foretrack
