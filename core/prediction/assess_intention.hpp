// SPDX-License-Identifier: Apache-2.0
// Scores of the intentions (paper §III.C). The set is open: one row of the table is one intention.
#pragma once

#include <array>

#include "core/prediction/motion_cues.hpp"
#include "core/prediction/reachable_region.hpp"

namespace foretrack {

/// What the potentials and observations are worked out from.
struct IntentionEvidence {
  const MotionCues& motion;
  const Surroundings& surroundings;
  // Maxima over the unexpected intentions; set before forward is scored.
  double strongest_potential = 0.0;
  double strongest_observation = 0.0;
};

/// To add an intention: its name in core/common/prediction.hpp, its row here, its test.
struct IntentionRow {
  Intention intention;
  double (*potential)(const IntentionEvidence&, const PredictionParams&);    // R
  double (*observation)(const IntentionEvidence&, const PredictionParams&);  // O
  MotionModel (*motion_model)(const PredictionParams&);                      // H of §IV
};
const std::array<IntentionRow, kIntentionCount>& intention_table();

/// Fills potential, observation and score of every belief (eq. 5–10); not the probability.
void assess_intention(const MotionCues& motion, const Surroundings& surroundings,
                      const PredictionParams& params, IntentionAssessment& assessment);

}  // namespace foretrack
