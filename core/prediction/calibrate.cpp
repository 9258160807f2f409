// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/calibrate.hpp"

#include <algorithm>

#include "core/prediction/dot.hpp"

namespace foretrack {
namespace {

template <int kFeatures>
double logit_of(const typename LogitWeights<kFeatures>::Row& features,
                const LogitWeights<kFeatures>& w) {
  double logit = dot(w.row, features);
  for (int j = 0; j < w.kHidden; ++j)
    if (w.hidden_gain[j] != 0.0)
      logit += w.hidden_gain[j] * std::tanh(w.hidden_bias[j] + dot(w.hidden[j], features));
  return logit;
}

}  // namespace

std::array<double, kIntentionCount> probabilities(const IntentionFeatures& f,
                                                  const CalibrationWeights& w) {
  std::array<double, kIntentionCount> p{};  // forward: logit 0
  p[index_of(Intention::kTurnLeft)] = logit_of(f.left, w.turn);
  p[index_of(Intention::kTurnRight)] = logit_of(f.right, w.turn);
  p[index_of(Intention::kDecelerate)] = logit_of(f.decelerate, w.decelerate);
  const double largest = *std::max_element(p.begin(), p.end());
  double sum = 0.0;
  for (double& x : p) sum += x = std::exp(x - largest);
  for (double& x : p) x /= sum;
  return p;
}

void calibrate(const MotionCues& motion, const Surroundings& surroundings, bool map_known,
               IntentionAssessment& assessment) {
  const auto features = intention_features(motion, surroundings, assessment, map_known);
  const auto& weights = calibration_weights(features.map_known, features.body_known);
  const auto p = probabilities(features, weights);
  for (int i = 0; i < kIntentionCount; ++i) assessment.beliefs[i].probability = p[i];
}

}  // namespace foretrack
