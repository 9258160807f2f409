// From evidence to probabilities that mean what they say.
#pragma once

#include "core/prediction/intention_features.hpp"

namespace foretrack {

/// Weights of a multinomial logistic model: forward has the logit 0, deceleration
/// w_decelerate · (its features), each turn w_turn · (its features) and, for what matters only
/// together (an opening and a wall ahead), a layer of hidden units.
struct CalibrationWeights {
  using TurnRow = std::array<double, IntentionFeatures::kTurnCount>;
  static constexpr int kHidden = 8;
  TurnRow turn{};
  std::array<TurnRow, kHidden> hidden{};
  std::array<double, kHidden> hidden_bias{};
  std::array<double, kHidden> hidden_gain{};
  std::array<double, IntentionFeatures::kDecelerateCount> decelerate{};
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
