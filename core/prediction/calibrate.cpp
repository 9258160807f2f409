// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/calibrate.hpp"

#include <cmath>
#include <limits>

#include "core/prediction/dot.hpp"

namespace foretrack {
namespace {

LogitView weights_of(const IntentionRow& row, bool map_known, bool body_known) {
  return row.head ? row.head->weights(map_known, body_known) : LogitView{};
}

double logit_of(const IntentionRow& row, const FeatureInputs& in) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  if (index_of(row.id) == 0) return 0.0;
  const LogitView weights = weights_of(row, in.map_known, in.evidence.motion.body_known);
  if (weights.empty()) return kNever;
  FeatureVector features;
  row.features(in, features);
  return logit_of(weights, features.first(row.head->features));
}

}  // namespace

double logit_of(const LogitView& w, std::span<const double> features) {
  const std::size_t n = features.size();
  if (w.row.size() != n || w.hidden.size() != n * w.hidden_gain.size())
    throw std::logic_error("logit_of: weights of another number of features");
  double logit = dot(w.row, features);
  for (std::size_t j = 0; j < w.hidden_gain.size(); ++j)
    if (w.hidden_gain[j] != 0.0)
      logit += w.hidden_gain[j] *
               std::tanh(w.hidden_bias[j] + dot(w.hidden.subspan(j * n, n), features));
  return logit;
}

void calibrate(const MotionCues& motion, const Surroundings& surroundings,
               const PredictionParams& params, bool map_known, IntentionAssessment& assessment,
               IntentionTable table) {
  const IntentionEvidence evidence{motion, surroundings, params};
  std::array<double, kMaxIntentions> p{};
  double largest = 0.0;  // that at place 0
  for (const IntentionRow& row : table) {
    double& logit = p[index_of(row.id)];
    logit = logit_of(row, {evidence, assessment[row.id], map_known});
    largest = std::max(largest, logit);
  }
  double sum = 0.0;
  for (const IntentionRow& row : table) {
    double& x = p[index_of(row.id)];
    sum += x = std::exp(x - largest);
  }
  for (const IntentionRow& row : table) assessment[row.id].probability = p[index_of(row.id)] / sum;
}

std::vector<std::string_view> unfitted(IntentionTable table) {
  std::vector<std::string_view> names;
  for (const IntentionRow& row : table.subspan(1)) {
    bool fitted = true;
    for (const bool map_known : {false, true})
      for (const bool body_known : {false, true})
        fitted = fitted && !weights_of(row, map_known, body_known).empty();
    if (!fitted) names.push_back(row.name);
  }
  return names;
}

}  // namespace foretrack
