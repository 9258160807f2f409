// SPDX-License-Identifier: Apache-2.0
// Scores of the intentions (paper §III.C). The set is open: see intentions/intention_table.hpp.
#pragma once

#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {

/// Fills potential, observation and score of every belief (eq. 5–11), and the margins; not the
/// probability.
void assess_intention(const MotionCues& motion, const Surroundings& surroundings,
                      const PredictionParams& params, IntentionAssessment& assessment,
                      IntentionTable table = kIntentions);

/// Of beliefs, scores and probabilities: share of one's own and the rest of the other's.
void mix(IntentionAssessment& assessment, const IntentionAssessment& other, double share,
         IntentionTable table = kIntentions);

/// The greatest score of the intentions that ask for each margin.
MarginScores margin_scores(const IntentionAssessment& assessment,
                           IntentionTable table = kIntentions);

}  // namespace foretrack
