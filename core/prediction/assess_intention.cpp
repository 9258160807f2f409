// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/assess_intention.hpp"

#include <algorithm>

namespace foretrack {
namespace {

void score(const IntentionRow& row, const IntentionEvidence& evidence,
           IntentionAssessment& assessment) {
  IntentionBelief& belief = assessment[row.id];
  belief.potential = row.potential(evidence);
  belief.observation = row.observation(evidence);
  const double sum = belief.potential + belief.observation;
  belief.score = 0.5 * (std::tanh(sum - evidence.params.b0_sensitivity) + 1.0);  // eq. 11
}

}  // namespace

void assess_intention(const MotionCues& motion, const Surroundings& surroundings,
                      const PredictionParams& params, IntentionAssessment& assessment,
                      IntentionTable table) {
  assessment.count = static_cast<int>(table.size());
  IntentionEvidence evidence{motion, surroundings, params};
  for (const IntentionRow& row : table.subspan(1)) {
    score(row, evidence, assessment);
    const IntentionBelief& b = assessment[row.id];
    evidence.strongest_potential = std::max(evidence.strongest_potential, b.potential);
    evidence.strongest_observation = std::max(evidence.strongest_observation, b.observation);
  }
  score(table.front(), evidence, assessment);
  assessment.margins = margin_scores(assessment, table);
  assessment.region = surroundings.region;
  assessment.region_ahead = surroundings.region_ahead;
  assessment.obstacle_distance_m = surroundings.obstacle_distance_m;
  assessment.body_turn_rad = motion.body_turn_rad;
}

void mix(IntentionAssessment& assessment, const IntentionAssessment& other, double share,
         IntentionTable table) {
  const auto blend = [share](double& own, double others) {
    own = share * own + (1.0 - share) * others;
  };
  for (const IntentionRow& row : table) {
    IntentionBelief& own = assessment[row.id];
    const IntentionBelief& others = other[row.id];
    blend(own.potential, others.potential);
    blend(own.observation, others.observation);
    blend(own.score, others.score);
    blend(own.probability, others.probability);
  }
  assessment.margins = margin_scores(assessment, table);
}

MarginScores margin_scores(const IntentionAssessment& assessment, IntentionTable table) {
  const auto greatest = [&](Margin margin) {
    double most = 0.0;
    for (const IntentionRow& row : table)
      if (row.margin == margin) most = std::max(most, assessment[row.id].score);
    return most;
  };
  return {greatest(Margin::kLeft), greatest(Margin::kRight), greatest(Margin::kDistance)};
}

}  // namespace foretrack
