// From evidence to probabilities that mean what they say.
#pragma once

#include "core/prediction/intention_features.hpp"

namespace foretrack {

/// Weights of a multinomial logistic model: forward has the logit 0, each turn w_turn · (its
/// features), deceleration w_decelerate · (its features).
struct CalibrationWeights {
  std::array<double, IntentionFeatures::kTurnCount> turn{};
  std::array<double, IntentionFeatures::kDecelerateCount> decelerate{};
};

/// Written by bench/prediction's fit_intention, which also says there what it was fitted on.
const CalibrationWeights& calibration_weights(bool map_known, bool body_known);

/// Probabilities of the intentions; they sum to 1.
std::array<double, kIntentionCount> probabilities(const IntentionFeatures& features,
                                                  const CalibrationWeights& weights);

/// Fills the probabilities of the beliefs from their scores and the evidence.
void calibrate(const MotionCues& motion, const Surroundings& surroundings, bool map_known,
               IntentionAssessment& assessment);

}  // namespace foretrack
