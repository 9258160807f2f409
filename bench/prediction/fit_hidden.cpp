#include "bench/prediction/fit_hidden.hpp"

#include "bench/prediction/adam.hpp"

namespace foretrack::bench {
namespace {

constexpr int kTurn = IntentionFeatures::kTurnCount;
constexpr int kDecelerate = IntentionFeatures::kDecelerateCount;
constexpr int kHidden = CalibrationWeights::kHidden;
constexpr int kEpochs = 20;
constexpr std::size_t kBatch = 512;
constexpr double kRate = 3e-3;
constexpr double kDecay = 1e-5;

using TurnVec = Eigen::Matrix<double, kTurn, 1>;
using HiddenVec = Eigen::Matrix<double, kHidden, 1>;

// All weights, or their gradient, or their moments. Features are standardised.
struct Model {
  Eigen::Matrix<double, kHidden, kTurn> hidden = Eigen::Matrix<double, kHidden, kTurn>::Zero();
  HiddenVec bias = HiddenVec::Zero(), gain = HiddenVec::Zero();
  TurnVec turn = TurnVec::Zero();
  Eigen::Matrix<double, kDecelerate, 1> decelerate = Eigen::Matrix<double, kDecelerate, 1>::Zero();

  template <class Visit>
  static void each(Model& a, Model& b, Model& c, Model& d, Visit&& visit) {
    visit(a.hidden.reshaped(), b.hidden.reshaped(), c.hidden.reshaped(), d.hidden.reshaped());
    visit(a.bias, b.bias, c.bias, d.bias);
    visit(a.gain, b.gain, c.gain, d.gain);
    visit(a.turn, b.turn, c.turn, d.turn);
    visit(a.decelerate, b.decelerate, c.decelerate, d.decelerate);
  }
};

struct Sample {
  TurnVec left, right;
  Eigen::Matrix<double, kDecelerate, 1> decelerate;
  int label = 0;
};

// The first feature is the constant: it stays as it is.
struct Scale {
  TurnVec mean = TurnVec::Zero(), inverse_sigma = TurnVec::Ones();
};

TurnVec vector_of(const std::array<double, kTurn>& x) {
  return Eigen::Map<const TurnVec>(x.data());
}

Scale scale_of(const std::vector<Window>& windows) {
  TurnVec sum = TurnVec::Zero(), squares = TurnVec::Zero();
  for (const Window& w : windows)
    for (const auto* side : {&w.features.left, &w.features.right}) {
      sum += vector_of(*side);
      squares += vector_of(*side).cwiseAbs2();
    }
  Scale scale;
  const double n = 2.0 * static_cast<double>(windows.size());
  for (int i = 1; i < kTurn; ++i) {
    const double variance = squares[i] / n - sum[i] * sum[i] / (n * n);
    scale.mean[i] = sum[i] / n;
    scale.inverse_sigma[i] = variance > 1e-12 ? 1.0 / std::sqrt(variance) : 0.0;
  }
  return scale;
}

std::vector<Sample> samples_of(const std::vector<Window>& windows, const Scale& scale) {
  std::vector<Sample> samples;
  for (const Window& w : windows) {
    Sample s;
    s.left = (vector_of(w.features.left) - scale.mean).cwiseProduct(scale.inverse_sigma);
    s.right = (vector_of(w.features.right) - scale.mean).cwiseProduct(scale.inverse_sigma);
    s.decelerate = Eigen::Map<const decltype(s.decelerate)>(w.features.decelerate.data());
    s.label = index_of(w.label);
    samples.push_back(s);
  }
  return samples;
}

void add_side(const Model& m, const TurnVec& x, const HiddenVec& h, double slope, Model& gradient) {
  const HiddenVec below = slope * m.gain.cwiseProduct((1.0 - h.array().square()).matrix());
  gradient.turn += slope * x;
  gradient.gain += slope * h;
  gradient.bias += below;
  gradient.hidden.noalias() += below * x.transpose();
}

void add_gradient(const Model& m, const Sample& s, double weight, Model& gradient) {
  const HiddenVec left = (m.hidden * s.left + m.bias).array().tanh().matrix();
  const HiddenVec right = (m.hidden * s.right + m.bias).array().tanh().matrix();
  Eigen::Vector4d p(0.0, m.turn.dot(s.left) + m.gain.dot(left),
                    m.turn.dot(s.right) + m.gain.dot(right), m.decelerate.dot(s.decelerate));
  p = (p.array() - p.maxCoeff()).exp().matrix();
  p /= p.sum();
  p[s.label] -= 1.0;
  p *= weight;
  add_side(m, s.left, left, p[1], gradient);
  add_side(m, s.right, right, p[2], gradient);
  gradient.decelerate += p[3] * s.decelerate;
}

Model start_of(const CalibrationWeights& w, const Scale& scale, Random& random) {
  Model m;
  const TurnVec turn = vector_of(w.turn);
  for (int i = 1; i < kTurn; ++i)
    if (scale.inverse_sigma[i] > 0.0) m.turn[i] = turn[i] / scale.inverse_sigma[i];
  m.turn[0] = turn.dot(scale.mean) + turn[0];
  m.decelerate = Eigen::Map<const decltype(m.decelerate)>(w.decelerate.data());
  for (double& x : m.hidden.reshaped()) x = random.normal() / std::sqrt(double(kTurn));
  for (double& x : m.gain) x = 0.1 * random.normal();
  return m;
}

// Back to features as they are.
CalibrationWeights weights_of(const Model& m, const Scale& scale) {
  CalibrationWeights w;
  const auto unscale = [&](const TurnVec& row, CalibrationWeights::TurnRow& out) {
    const TurnVec raw = row.cwiseProduct(scale.inverse_sigma);
    for (int i = 0; i < kTurn; ++i) out[i] = raw[i];
    return raw.dot(scale.mean);
  };
  w.turn[0] -= unscale(m.turn, w.turn);
  for (int j = 0; j < kHidden; ++j) {
    w.hidden_bias[j] = m.bias[j] - unscale(m.hidden.row(j).transpose(), w.hidden[j]);
    w.hidden_gain[j] = m.gain[j];
  }
  for (int i = 0; i < kDecelerate; ++i) w.decelerate[i] = m.decelerate[i];
  return w;
}

}  // namespace

CalibrationWeights fit_hidden(const std::vector<Window>& windows, const CalibrationWeights& start) {
  Random random(7);
  const Scale scale = scale_of(windows);
  const std::vector<Sample> samples = samples_of(windows, scale);
  Model model = start_of(start, scale, random);
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
  return weights_of(model, scale);
}

}  // namespace foretrack::bench
