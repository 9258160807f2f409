// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/predict.hpp"

#include "core/prediction/assess_intention.hpp"
#include "core/prediction/calibrate.hpp"
#include "core/prediction/predict_paths.hpp"

namespace foretrack {
namespace {

bool is_finite(const TargetState& target) {
  return std::isfinite(target.stamp_s) && target.position_enu_m.allFinite() &&
         target.velocity_enu_m_s.allFinite() && target.covariance.allFinite();
}

// A chest counts as far as what it told came true lately; the rest is told without it.
void assess(const MotionCues& motion, const Surroundings& surroundings,
            const PredictionParams& params, bool map_known, IntentionAssessment& assessment,
            IntentionTable table) {
  assess_intention(motion, surroundings, params, assessment, table);
  calibrate(motion, surroundings, params, map_known, assessment, table);
  if (!motion.body_known) return;
  IntentionAssessment faceless;
  const MotionCues cues = without_chest(motion);
  assess_intention(cues, surroundings, params, faceless, table);
  calibrate(cues, surroundings, params, map_known, faceless, table);
  mix(assessment, faceless, motion.chest_trust, table);
}

}  // namespace

const PredictionResult& predict(PredictionState& state, const TargetState& target,
                                const GridMap& map, const PredictionParams& params,
                                IntentionTable table) {
  PredictionResult& result = state.result;
  result.intention = {};
  result.intention.stamp_s = target.stamp_s;
  result.intention.count = static_cast<int>(table.size());
  if (!target.usable() || !is_finite(target)) {
    clear_prediction(state, target.stamp_s, PredictionStatus::kNoTarget);
    return result;
  }
  const MotionCues motion = observe_motion(state.memory, target, params);
  const Surroundings surroundings = observe_surroundings(map, motion, params);  // §III.B
  assess(motion, surroundings, params, !map.empty(), result.intention, table);  // §III.C
  predict_paths(state, target, motion, map, params, table);                     // §IV
  return result;
}

}  // namespace foretrack
