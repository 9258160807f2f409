// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/fit_hidden.hpp"

#include "bench/prediction/adam.hpp"

namespace foretrack::bench {
namespace {

constexpr int kTurn = IntentionFeatures::kTurnCount;
constexpr int kDecelerate = IntentionFeatures::kDecelerateCount;
constexpr int kEpochs = 20;
constexpr std::size_t kBatch = 512;
constexpr double kRate = 3e-3;
constexpr double kDecay = 1e-5;

template <int kFeatures>
using Vec = Eigen::Matrix<double, kFeatures, 1>;

template <int kFeatures>
Vec<kFeatures> vector_of(const typename LogitWeights<kFeatures>::Row& x) {
  return Eigen::Map<const Vec<kFeatures>>(x.data());
}

// To standardised features. The first is the constant: it stays as it is.
template <int kFeatures>
struct Scale {
  Vec<kFeatures> mean = Vec<kFeatures>::Zero(), inverse_sigma = Vec<kFeatures>::Ones();

  explicit Scale(const Eigen::Matrix<double, kFeatures, Eigen::Dynamic>& all) {
    mean.template tail<kFeatures - 1>() = all.rowwise().mean().template tail<kFeatures - 1>();
    for (int i = 1; i < kFeatures; ++i) {
      const double variance = (all.row(i).array() - mean[i]).square().mean();
      inverse_sigma[i] = variance > 1e-12 ? 1.0 / std::sqrt(variance) : 0.0;
    }
  }
  Vec<kFeatures> operator()(const typename LogitWeights<kFeatures>::Row& x) const {
    return (vector_of<kFeatures>(x) - mean).cwiseProduct(inverse_sigma);
  }
};

// One intention's logit, or its gradient, or its moments; of standardised features.
template <int kFeatures>
struct Logit {
  using Weights = LogitWeights<kFeatures>;
  using HiddenVec = Vec<Weights::kHidden>;
  using X = Vec<kFeatures>;
  Eigen::Matrix<double, Weights::kHidden, kFeatures> hidden = decltype(hidden)::Zero();
  HiddenVec bias = HiddenVec::Zero(), gain = HiddenVec::Zero();
  X row = X::Zero();

  template <class Visit>
  static void each(Logit& a, Logit& b, Logit& c, Logit& d, Visit&& visit) {
    visit(a.hidden.reshaped(), b.hidden.reshaped(), c.hidden.reshaped(), d.hidden.reshaped());
    visit(a.bias, b.bias, c.bias, d.bias);
    visit(a.gain, b.gain, c.gain, d.gain);
    visit(a.row, b.row, c.row, d.row);
  }

  void start(const Weights& w, const Scale<kFeatures>& scale, Random& random) {
    const X raw = vector_of<kFeatures>(w.row);
    for (int i = 1; i < kFeatures; ++i)
      if (scale.inverse_sigma[i] > 0.0) row[i] = raw[i] / scale.inverse_sigma[i];
    row[0] = raw.dot(scale.mean) + raw[0];
    for (double& x : hidden.reshaped()) x = random.normal() / std::sqrt(double(kFeatures));
    for (double& x : gain) x = 0.1 * random.normal();
  }

  HiddenVec units(const X& x) const { return (hidden * x + bias).array().tanh().matrix(); }
  double value(const X& x, const HiddenVec& h) const { return row.dot(x) + gain.dot(h); }

  void add_gradient(const X& x, const HiddenVec& h, double slope, Logit& gradient) const {
    const HiddenVec below = slope * gain.cwiseProduct((1.0 - h.array().square()).matrix());
    gradient.row += slope * x;
    gradient.gain += slope * h;
    gradient.bias += below;
    gradient.hidden.noalias() += below * x.transpose();
  }

  // Back to features as they are.
  Weights weights(const Scale<kFeatures>& scale) const {
    Weights w;
    const auto unscale = [&](const X& from, typename Weights::Row& to) {
      const X raw = from.cwiseProduct(scale.inverse_sigma);
      for (int i = 0; i < kFeatures; ++i) to[i] = raw[i];
      return raw.dot(scale.mean);
    };
    w.row[0] -= unscale(row, w.row);
    for (int j = 0; j < Weights::kHidden; ++j) {
      w.hidden_bias[j] = bias[j] - unscale(hidden.row(j).transpose(), w.hidden[j]);
      w.hidden_gain[j] = gain[j];
    }
    return w;
  }
};

struct Model {
  Logit<kTurn> turn;
  Logit<kDecelerate> decelerate;

  template <class Visit>
  static void each(Model& a, Model& b, Model& c, Model& d, Visit&& visit) {
    Logit<kTurn>::each(a.turn, b.turn, c.turn, d.turn, visit);
    Logit<kDecelerate>::each(a.decelerate, b.decelerate, c.decelerate, d.decelerate, visit);
  }
};

struct Sample {
  Vec<kTurn> left, right;
  Vec<kDecelerate> decelerate;
  int label = 0;
};

Scale<kTurn> scale_of_turns(const std::vector<Window>& windows) {
  Eigen::Matrix<double, kTurn, Eigen::Dynamic> all(kTurn, 2 * windows.size());
  Eigen::Index i = 0;
  for (const Window& w : windows)
    for (const auto* side : {&w.features.left, &w.features.right})
      all.col(i++) = vector_of<kTurn>(*side);
  return Scale<kTurn>(all);
}

Scale<kDecelerate> scale_of_deceleration(const std::vector<Window>& windows) {
  Eigen::Matrix<double, kDecelerate, Eigen::Dynamic> all(kDecelerate, windows.size());
  Eigen::Index i = 0;
  for (const Window& w : windows) all.col(i++) = vector_of<kDecelerate>(w.features.decelerate);
  return Scale<kDecelerate>(all);
}

void add_gradient(const Model& m, const Sample& s, double weight, Model& gradient) {
  const auto left = m.turn.units(s.left), right = m.turn.units(s.right);
  const auto decelerate = m.decelerate.units(s.decelerate);
  Eigen::Vector4d p(0.0, m.turn.value(s.left, left), m.turn.value(s.right, right),
                    m.decelerate.value(s.decelerate, decelerate));
  p = (p.array() - p.maxCoeff()).exp().matrix();
  p /= p.sum();
  p[s.label] -= 1.0;
  p *= weight;
  m.turn.add_gradient(s.left, left, p[1], gradient.turn);
  m.turn.add_gradient(s.right, right, p[2], gradient.turn);
  m.decelerate.add_gradient(s.decelerate, decelerate, p[3], gradient.decelerate);
}

}  // namespace

CalibrationWeights fit_hidden(const std::vector<Window>& windows, const CalibrationWeights& start) {
  Random random(7);
  const Scale<kTurn> turns = scale_of_turns(windows);
  const Scale<kDecelerate> deceleration = scale_of_deceleration(windows);
  std::vector<Sample> samples;
  for (const auto& [f, label] : windows)
    samples.push_back({turns(f.left), turns(f.right), deceleration(f.decelerate), index_of(label)});
  Model model;
  model.turn.start(start.turn, turns, random);
  model.decelerate.start(start.decelerate, deceleration, random);
  Adam<Model> adam(kDecay);
  Shuffled shuffled(samples.size(), random);
  for (int epoch = 0; epoch < kEpochs; ++epoch) {
    const std::vector<std::size_t>& order = shuffled.next();
    const double rate = kRate * (1.0 - double(epoch) / kEpochs);
    for (std::size_t from = 0; from < order.size(); from += kBatch) {
      const std::size_t to = std::min(order.size(), from + kBatch);
      Model gradient;
      for (std::size_t i = from; i < to; ++i)
        add_gradient(model, samples[order[i]], 1.0 / double(to - from), gradient);
      adam.step(model, gradient, rate);
    }
  }
  return {model.turn.weights(turns), model.decelerate.weights(deceleration)};
}

}  // namespace foretrack::bench
