// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/fit_softmax.hpp"

#include <Eigen/Cholesky>

namespace foretrack::bench {
namespace {

constexpr int kTurn = IntentionFeatures::kTurnCount;
constexpr int kDecelerate = IntentionFeatures::kDecelerateCount;
constexpr int kAll = kTurn + kDecelerate;
using VecN = Eigen::Matrix<double, kAll, 1>;
using MatN = Eigen::Matrix<double, kAll, kAll>;
using Inputs = Eigen::Matrix<double, kAll, kIntentionCount>;

// Column i · weights is the logit of intention i.
Inputs inputs_of(const IntentionFeatures& f) {
  Inputs x = Inputs::Zero();
  x.col(1).head<kTurn>() = Eigen::Map<const Eigen::Matrix<double, kTurn, 1>>(f.left.data());
  x.col(2).head<kTurn>() = Eigen::Map<const Eigen::Matrix<double, kTurn, 1>>(f.right.data());
  x.col(3).tail<kDecelerate>() =
      Eigen::Map<const Eigen::Matrix<double, kDecelerate, 1>>(f.decelerate.data());
  return x;
}

CalibrationWeights weights_of(const VecN& w) {
  CalibrationWeights weights;
  for (int i = 0; i < kTurn; ++i) weights.turn.row[i] = w[i];
  for (int i = 0; i < kDecelerate; ++i) weights.decelerate.row[i] = w[kTurn + i];
  return weights;
}

struct Slope {
  VecN gradient = VecN::Zero();
  MatN hessian = MatN::Zero();
};

Slope slope_at(const std::vector<Window>& windows, const VecN& w, double ridge) {
  Slope slope;
  const CalibrationWeights weights = weights_of(w);
  for (const Window& window : windows) {
    const auto p = probabilities(window.features, weights);
    const Inputs x = inputs_of(window.features);
    VecN mean = VecN::Zero();
    for (int i = 1; i < kIntentionCount; ++i) {
      mean += p[i] * x.col(i);
      slope.hessian.selfadjointView<Eigen::Lower>().rankUpdate(x.col(i), p[i]);
    }
    slope.hessian.selfadjointView<Eigen::Lower>().rankUpdate(mean, -1.0);
    slope.gradient += mean - x.col(index_of(window.label));
  }
  VecN penalty = VecN::Constant(ridge * static_cast<double>(windows.size()));
  penalty[0] = penalty[kTurn] = 1e-6;
  slope.gradient += penalty.cwiseProduct(w);
  slope.hessian.diagonal() += penalty;
  return slope;
}

}  // namespace

double mean_log_loss(const std::vector<Window>& windows, const CalibrationWeights& weights) {
  double sum = 0.0;
  for (const Window& w : windows)
    sum -= std::log(std::max(1e-9, probabilities(w.features, weights)[index_of(w.label)]));
  return windows.empty() ? 0.0 : sum / static_cast<double>(windows.size());
}

CalibrationWeights fit_softmax(const std::vector<Window>& windows, double ridge) {
  VecN w = VecN::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Slope slope = slope_at(windows, w, ridge);
    const MatN hessian = slope.hessian.selfadjointView<Eigen::Lower>();
    VecN step = hessian.ldlt().solve(slope.gradient);
    if (step.norm() > 5.0) step *= 5.0 / step.norm();  // far from the optimum Newton overshoots
    w -= step;
    if (step.norm() < 1e-6) break;
  }
  return weights_of(w);
}

}  // namespace foretrack::bench
