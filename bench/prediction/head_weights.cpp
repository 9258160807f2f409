// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/head_weights.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack::bench {

Row features_of(const Heads& heads, std::size_t place, const Window& window) {
  const Heads::Place& p = heads.places[place];
  return Eigen::Map<const Eigen::VectorXf>(window.features.data() + p.first, heads.size(p.head))
      .cast<double>();
}

Eigen::VectorXd softmax(Eigen::VectorXd logits) {
  logits = (logits.array() - logits.maxCoeff()).exp().matrix();
  return logits / logits.sum();
}

double mean_log_loss(const std::vector<Window>& windows, const Heads& heads,
                     const ModelWeights& weights) {
  const std::size_t count = heads.places.size();
  double sum = 0.0;
  for (const Window& w : windows) {
    Eigen::VectorXd logits = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i)
      if (const int head = heads.places[i].head; head >= 0)
        logits[static_cast<Eigen::Index>(i)] = weights[head].logit(features_of(heads, i, w));
    sum -= std::log(std::max(1e-9, softmax(logits)[w.label]));
  }
  return windows.empty() ? 0.0 : sum / static_cast<double>(windows.size());
}

}  // namespace foretrack::bench
