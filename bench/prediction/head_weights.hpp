// SPDX-License-Identifier: Apache-2.0
// The weights of a head while they are fitted, of any number of features.
#pragma once

#include <Eigen/Core>

#include "bench/prediction/windows.hpp"

namespace foretrack::bench {

using Row = Eigen::VectorXd;

struct HeadWeights {
  static constexpr int kHidden = LogitWeights<1>::kHidden;
  Row row;
  Eigen::MatrixXd hidden;  // kHidden × features
  Eigen::VectorXd bias, gain;

  explicit HeadWeights(int features = 0)
      : row(Row::Zero(features)),
        hidden(Eigen::MatrixXd::Zero(kHidden, features)),
        bias(Eigen::VectorXd::Zero(kHidden)),
        gain(Eigen::VectorXd::Zero(kHidden)) {}

  Eigen::VectorXd units(const Row& x) const { return (hidden * x + bias).array().tanh().matrix(); }
  double logit(const Row& x) const { return row.dot(x) + gain.dot(units(x)); }
};

/// One for each head.
using ModelWeights = std::vector<HeadWeights>;

/// The features of a window that belong to an intention.
Row features_of(const Heads& heads, std::size_t place, const Window& window);

/// The multinomial logistic model of core/prediction/calibrate.hpp: one probability an intention.
Eigen::VectorXd softmax(Eigen::VectorXd logits);
double mean_log_loss(const std::vector<Window>& windows, const Heads& heads,
                     const ModelWeights& weights);

}  // namespace foretrack::bench
