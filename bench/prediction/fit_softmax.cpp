// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/fit_softmax.hpp"

#include <Eigen/Cholesky>

namespace foretrack::bench {
namespace {

using Eigen::Index;
using Vec = Eigen::VectorXd;
using Mat = Eigen::MatrixXd;

// Where the row of each head is in the vector of all weights.
std::vector<Index> offsets_of(const Heads& heads) {
  std::vector<Index> offsets = {0};
  for (const IntentionHead* head : heads.heads) offsets.push_back(offsets.back() + head->features);
  return offsets;
}

struct Slope {
  Vec gradient;
  Mat hessian;  // the lower half
};

class Problem {
 public:
  Problem(const std::vector<Window>& windows, const Heads& heads, double ridge)
      : windows_(windows), heads_(heads), offsets_(offsets_of(heads)), ridge_(ridge) {}

  Index size() const { return offsets_.back(); }

  Slope slope_at(const Vec& w) const {
    Slope slope{Vec::Zero(size()), Mat::Zero(size(), size())};
    for (const Window& window : windows_) add(window, w, slope);
    Vec penalty = Vec::Constant(size(), ridge_ * static_cast<double>(windows_.size()));
    for (std::size_t h = 0; h + 1 < offsets_.size(); ++h) penalty[offsets_[h]] = 1e-6;
    slope.gradient += penalty.cwiseProduct(w);
    slope.hessian.diagonal() += penalty;
    return slope;
  }

  ModelWeights weights_of(const Vec& w) const {
    ModelWeights weights;
    for (std::size_t h = 0; h < heads_.heads.size(); ++h) {
      const int n = heads_.size(static_cast<int>(h));
      weights.emplace_back(n).row = w.segment(offsets_[h], n);
    }
    return weights;
  }

 private:
  void add(const Window& window, const Vec& w, Slope& slope) const {
    const std::size_t count = heads_.places.size();
    Vec logits = Vec::Zero(static_cast<Index>(count));
    std::vector<Row> x(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (heads_.places[i].head < 0) continue;
      x[i] = features_of(heads_, i, window);
      logits[static_cast<Index>(i)] = x[i].dot(w.segment(first(i), x[i].size()));
    }
    const Vec p = softmax(logits);
    Vec mean = Vec::Zero(size());
    for (std::size_t i = 0; i < count; ++i) {
      if (heads_.places[i].head < 0) continue;
      const double p_i = p[static_cast<Index>(i)];
      const Index n = x[i].size();
      mean.segment(first(i), n) += p_i * x[i];
      slope.hessian.block(first(i), first(i), n, n)
          .selfadjointView<Eigen::Lower>()
          .rankUpdate(x[i], p_i);
      if (static_cast<int>(i) == window.label) slope.gradient.segment(first(i), n) -= x[i];
    }
    slope.hessian.selfadjointView<Eigen::Lower>().rankUpdate(mean, -1.0);
    slope.gradient += mean;
  }
  Index first(std::size_t place) const {
    return offsets_[static_cast<std::size_t>(heads_.places[place].head)];
  }

  const std::vector<Window>& windows_;
  const Heads& heads_;
  std::vector<Index> offsets_;
  double ridge_;
};

}  // namespace

ModelWeights fit_softmax(const std::vector<Window>& windows, const Heads& heads, double ridge) {
  const Problem problem(windows, heads, ridge);
  Vec w = Vec::Zero(problem.size());
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Slope slope = problem.slope_at(w);
    const Mat hessian = slope.hessian.selfadjointView<Eigen::Lower>();
    Vec step = hessian.ldlt().solve(slope.gradient);
    if (step.norm() > 5.0) step *= 5.0 / step.norm();  // far from the optimum Newton overshoots
    w -= step;
    if (step.norm() < 1e-4) break;
  }
  return problem.weights_of(w);
}

}  // namespace foretrack::bench
