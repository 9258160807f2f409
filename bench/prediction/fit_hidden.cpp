// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/fit_hidden.hpp"

#include "bench/prediction/adam.hpp"

namespace foretrack::bench {
namespace {

using Eigen::Index;
using Vec = Eigen::VectorXd;

constexpr int kEpochs = 20;
constexpr std::size_t kBatch = 512;
constexpr double kRate = 3e-3;
constexpr double kDecay = 1e-5;

// To standardised features. The first is the constant: it stays as it is.
struct Scale {
  Vec mean, inverse_sigma;

  explicit Scale(Index features) : mean(Vec::Zero(features)), inverse_sigma(Vec::Ones(features)) {}
  Row operator()(const Row& x) const { return (x - mean).cwiseProduct(inverse_sigma); }
};

// Of each head, over all intentions that share it.
std::vector<Scale> scales_of(const std::vector<Window>& windows, const Heads& heads) {
  std::vector<Scale> scales;
  for (int h = 0; h < static_cast<int>(heads.heads.size()); ++h) {
    Scale& scale = scales.emplace_back(heads.size(h));
    Vec sum = Vec::Zero(heads.size(h)), squares = sum;
    double n = 0.0;
    for (std::size_t i = 0; i < heads.places.size(); ++i) {
      if (heads.places[i].head != h) continue;
      for (const Window& w : windows) {
        const Row x = features_of(heads, i, w);
        sum += x;
        squares += x.cwiseAbs2();
        n += 1.0;
      }
    }
    for (Index k = 1; k < sum.size(); ++k) {
      scale.mean[k] = sum[k] / n;
      const double variance = squares[k] / n - scale.mean[k] * scale.mean[k];
      scale.inverse_sigma[k] = variance > 1e-9 ? 1.0 / std::sqrt(variance) : 0.0;
    }
  }
  return scales;
}

// From weights of features as they are to those of standardised ones, with hidden units that hardly
// count yet.
HeadWeights started(const HeadWeights& raw, const Scale& scale, Random& random) {
  const Index n = raw.row.size();
  HeadWeights w(static_cast<int>(n));
  for (Index k = 1; k < n; ++k)
    if (scale.inverse_sigma[k] > 0.0) w.row[k] = raw.row[k] / scale.inverse_sigma[k];
  w.row[0] = raw.row.dot(scale.mean) + raw.row[0];
  for (double& x : w.hidden.reshaped()) x = random.normal() / std::sqrt(static_cast<double>(n));
  for (double& x : w.gain) x = 0.1 * random.normal();
  return w;
}

// And back.
HeadWeights finished(const HeadWeights& w, const Scale& scale) {
  HeadWeights raw = w;
  raw.row = w.row.cwiseProduct(scale.inverse_sigma);
  raw.row[0] -= raw.row.dot(scale.mean);
  raw.hidden = w.hidden * scale.inverse_sigma.asDiagonal();
  raw.bias = w.bias - raw.hidden * scale.mean;
  return raw;
}

// Weights, their gradient, or its moments.
struct Model {
  ModelWeights heads;

  void resize_like(const Model& other) {
    if (!heads.empty()) return;
    for (const HeadWeights& w : other.heads) heads.emplace_back(static_cast<int>(w.row.size()));
  }

  template <class Visit>
  static void each(Model& a, Model& b, Model& c, Model& d, Visit&& visit) {
    for (Model* m : {&b, &c, &d}) m->resize_like(a);
    for (std::size_t h = 0; h < a.heads.size(); ++h) {
      HeadWeights &p = a.heads[h], &q = b.heads[h], &r = c.heads[h], &s = d.heads[h];
      visit(p.hidden.reshaped(), q.hidden.reshaped(), r.hidden.reshaped(), s.hidden.reshaped());
      visit(p.bias, q.bias, r.bias, s.bias);
      visit(p.gain, q.gain, r.gain, s.gain);
      visit(p.row, q.row, r.row, s.row);
    }
  }
};

void add_gradient(const HeadWeights& w, const Row& x, const Vec& units, double slope,
                  HeadWeights& gradient) {
  const Vec below = slope * w.gain.cwiseProduct((1.0 - units.array().square()).matrix());
  gradient.row += slope * x;
  gradient.gain += slope * units;
  gradient.bias += below;
  gradient.hidden.noalias() += below * x.transpose();
}

void add_gradient(const Model& m, const Heads& heads, const std::vector<Scale>& scales,
                  const Window& window, double weight, Model& gradient) {
  const std::size_t count = heads.places.size();
  Vec logits = Vec::Zero(static_cast<Index>(count));
  std::vector<Row> x(count);
  std::vector<Vec> units(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int h = heads.places[i].head;
    if (h < 0) continue;
    x[i] = scales[h](features_of(heads, i, window));
    units[i] = m.heads[h].units(x[i]);
    logits[static_cast<Index>(i)] = m.heads[h].row.dot(x[i]) + m.heads[h].gain.dot(units[i]);
  }
  Vec p = softmax(logits);
  p[window.label] -= 1.0;
  for (std::size_t i = 0; i < count; ++i)
    if (const int h = heads.places[i].head; h >= 0)
      add_gradient(m.heads[h], x[i], units[i], weight * p[static_cast<Index>(i)],
                   gradient.heads[h]);
}

}  // namespace

ModelWeights fit_hidden(const std::vector<Window>& windows, const Heads& heads,
                        const ModelWeights& start) {
  Random random(7);
  const std::vector<Scale> scales = scales_of(windows, heads);
  Model model;
  for (std::size_t h = 0; h < start.size(); ++h)
    model.heads.push_back(started(start[h], scales[h], random));
  Adam<Model> adam(kDecay);
  Shuffled shuffled(windows.size(), random);
  for (int epoch = 0; epoch < kEpochs; ++epoch) {
    const std::vector<std::size_t>& order = shuffled.next();
    const double rate = kRate * (1.0 - double(epoch) / kEpochs);
    for (std::size_t from = 0; from < order.size(); from += kBatch) {
      const std::size_t to = std::min(order.size(), from + kBatch);
      Model gradient;
      gradient.resize_like(model);
      for (std::size_t i = from; i < to; ++i)
        add_gradient(model, heads, scales, windows[order[i]], 1.0 / double(to - from), gradient);
      adam.step(model, gradient, rate);
    }
  }
  ModelWeights weights;
  for (std::size_t h = 0; h < start.size(); ++h)
    weights.push_back(finished(model.heads[h], scales[h]));
  return weights;
}

}  // namespace foretrack::bench
