// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/windows.hpp"

#include <algorithm>
#include <limits>

#include "core/prediction/assess_intention.hpp"

namespace foretrack::bench {
namespace {

// Of what is believed: who has just stopped but still seems to walk, for a filter is late, is one
// whose speed halves, or who turns back. The truth alone would teach that nothing follows the signs
// of a stop.
std::optional<Intention> label_of(const Truth& truth, int i, const TargetState& target) {
  constexpr double kLate_s = 0.4, kWalking_m_s = 0.3;
  if (const auto label = label_at(truth, i)) return label;
  const int before = std::max(0, i - truth.steps(kLate_s));
  const double speed_m_s = truth.samples[i].speed_m_s();
  const bool just_stopped = i + truth.steps(1.0) < truth.count() && speed_m_s < kWalking_m_s &&
                            truth.samples[before].speed_m_s() > 2.0 * kWalking_m_s;
  if (!just_stopped || target.speed_m_s() < 2.0 * speed_m_s) return std::nullopt;
  const bool to_turn_back = label_at(truth, before) == Intention::kTurnBack;
  return to_turn_back ? Intention::kTurnBack : Intention::kDecelerate;
}

Window window_of(const IntentionEvidence& evidence, const IntentionAssessment& assessment,
                 bool map_known, Intention label) {
  Window window{{}, index_of(label)};
  for (const IntentionRow& row : kIntentions) {
    if (!row.head) continue;
    FeatureVector features;
    row.features({evidence, assessment[row.id], map_known}, features);
    const auto all = features.first(row.head->features);
    window.features.insert(window.features.end(), all.begin(), all.end());
  }
  return window;
}

}  // namespace

Heads heads_of(IntentionTable table) {
  Heads all;
  for (const IntentionRow& row : table) {
    Heads::Place& place = all.places.emplace_back();
    if (!row.head) continue;
    const auto found = std::ranges::find(all.heads, row.head);
    place = {static_cast<int>(found - all.heads.begin()), all.features};
    if (found == all.heads.end()) all.heads.push_back(row.head);
    all.features += row.head->features;
  }
  return all;
}

std::vector<Window> windows_of(const Episode& episode, const PredictionParams& params) {
  constexpr int kEvery = 3;
  const GridMap& map = episode.map;
  std::vector<Window> windows;
  MotionMemory memory;
  for (int k = 0; k < static_cast<int>(episode.estimates.size()); ++k) {
    const TargetState& target = episode.estimates[k];
    const MotionCues motion = observe_motion(memory, target, params);
    if (k % kEvery != 0) continue;
    const auto label = label_of(episode.truth, k * kTruthPerEstimate, target);
    if (!label) continue;
    const Surroundings surroundings = observe_surroundings(map, motion, params);
    IntentionAssessment assessment;
    assess_intention(motion, surroundings, params, assessment);
    windows.push_back(window_of({motion, surroundings, params}, assessment, !map.empty(), *label));
  }
  return windows;
}

}  // namespace foretrack::bench
