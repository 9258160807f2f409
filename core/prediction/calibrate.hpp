// SPDX-License-Identifier: Apache-2.0
// From evidence to probabilities that mean what they say: a multinomial logistic model, one fitted
// head an intention. The logit at place 0 is 0.
#pragma once

#include <vector>

#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {

/// Features and weights of as many numbers. Cost: some 1000 flops. Throws std::logic_error if the
/// sizes do not belong together.
double logit_of(const LogitView& weights, std::span<const double> features);

/// Fills the probabilities of the beliefs from their scores and the evidence; they sum to 1. An
/// intention without a fitted head has 0. Cost: about a microsecond.
void calibrate(const MotionCues& motion, const Surroundings& surroundings,
               const PredictionParams& params, bool map_known, IntentionAssessment& assessment,
               IntentionTable table = kIntentions);

/// The names of the intentions without a fitted head, in all or some of the states of knowledge:
/// whoever starts prediction says so. Empty for what is shipped.
std::vector<std::string_view> unfitted(IntentionTable table = kIntentions);

}  // namespace foretrack
