#include "bench/prediction/windows.hpp"

#include <limits>

namespace foretrack::bench {

std::vector<Window> windows_of(const Episode& episode, const PredictionParams& params,
                               bool hide_map, bool hide_body) {
  constexpr int kEvery = 3;
  const GridMap nothing;
  const GridMap& map = hide_map ? nothing : episode.map;
  std::vector<Window> windows;
  MotionHistory history;
  for (int k = 0; k < static_cast<int>(episode.estimates.size()); ++k) {
    TargetState target = episode.estimates[k];
    if (hide_body) target.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
    const MotionCues motion = observe_motion(history, target, params);
    if (k % kEvery != 0) continue;
    const auto label = label_at(episode.truth, k * kTruthPerEstimate);
    if (!label) continue;
    const Surroundings surroundings = observe_surroundings(map, motion, params);
    IntentionAssessment assessment;
    assess_intention(motion, surroundings, params, assessment);
    windows.push_back({intention_features(motion, surroundings, assessment, !map.empty()), *label});
  }
  return windows;
}

}  // namespace foretrack::bench
