// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/fit_network.hpp"

#include "bench/prediction/adam.hpp"

namespace foretrack::bench {
namespace {

using W = ShortTermWeights;
constexpr int kEven = ShortTermFeatures::kEven, kOdd = ShortTermFeatures::kOdd;
constexpr int kEpochs = 24;
constexpr std::size_t kBatch = 256;
constexpr double kRate = 3e-3;
constexpr double kDecay = 1e-6;

using Even = Eigen::Matrix<double, kEven, Eigen::Dynamic>;
using Odd = Eigen::Matrix<double, kOdd, Eigen::Dynamic>;
using Hidden = Eigen::Matrix<double, W::kHidden, Eigen::Dynamic>;
using Outputs = Eigen::Matrix<double, W::kOutputs, Eigen::Dynamic>;

// All weights, or their gradient, or their moments. Features and outputs are in their own scales.
struct Network {
  Eigen::Matrix<double, W::kHidden, kEven> hidden_even = decltype(hidden_even)::Zero();
  Eigen::Matrix<double, W::kHidden, kOdd> hidden_odd = decltype(hidden_odd)::Zero();
  Eigen::Matrix<double, W::kOutputs, W::kHidden> along_hidden = decltype(along_hidden)::Zero();
  Eigen::Matrix<double, W::kOutputs, W::kHidden> across_hidden = decltype(across_hidden)::Zero();
  Eigen::Matrix<double, W::kOutputs, kEven> along_even = decltype(along_even)::Zero();
  Eigen::Matrix<double, W::kOutputs, kOdd> across_odd = decltype(across_odd)::Zero();

  template <class Visit>
  static void each(Network& a, Network& b, Network& c, Network& d, Visit&& visit) {
    visit(a.hidden_even, b.hidden_even, c.hidden_even, d.hidden_even);
    visit(a.hidden_odd, b.hidden_odd, c.hidden_odd, d.hidden_odd);
    visit(a.along_hidden, b.along_hidden, c.along_hidden, d.along_hidden);
    visit(a.across_hidden, b.across_hidden, c.across_hidden, d.across_hidden);
    visit(a.along_even, b.along_even, c.along_even, d.along_even);
    visit(a.across_odd, b.across_odd, c.across_odd, d.across_odd);
  }
};

// Samples side by side, in units of their root mean squares.
struct Data {
  Even even;
  Odd odd;
  Outputs along, across;
  Eigen::VectorXd even_unit, odd_unit, output_unit;
};

template <class Matrix>
Eigen::VectorXd scale_rows(Matrix& m) {
  const Eigen::VectorXd unit =
      (m.rowwise().squaredNorm() / static_cast<double>(m.cols())).cwiseSqrt().cwiseMax(1e-9);
  m.array().colwise() /= unit.array();
  return unit;
}

Data data_of(const std::vector<ShortTermSample>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Data d{
      Even(kEven, n), Odd(kOdd, n), Outputs(W::kOutputs, n), Outputs(W::kOutputs, n), {}, {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const ShortTermSample& s = samples[static_cast<std::size_t>(i)];
    d.even.col(i) = Eigen::Map<const Eigen::VectorXd>(s.features.even.data(), kEven);
    d.odd.col(i) = Eigen::Map<const Eigen::VectorXd>(s.features.odd.data(), kOdd);
    for (int k = 0; k < W::kOutputs; ++k) {
      d.along(k, i) = s.errors[k].x();
      d.across(k, i) = s.errors[k].y();
    }
  }
  d.even_unit = scale_rows(d.even);
  d.odd_unit = scale_rows(d.odd);
  d.output_unit = ((d.along.rowwise().squaredNorm() + d.across.rowwise().squaredNorm()) / double(n))
                      .cwiseSqrt();
  d.along.array().colwise() /= d.output_unit.array();
  d.across.array().colwise() /= d.output_unit.array();
  return d;
}

Network gradient_of(const Network& n, const Even& even, const Odd& odd, const Outputs& along,
                    const Outputs& across) {
  const Hidden of_even = n.hidden_even * even, of_odd = n.hidden_odd * odd;
  const Hidden here = (of_even + of_odd).array().tanh(),
               mirrored = (of_even - of_odd).array().tanh();
  const Hidden sum = here + mirrored, difference = here - mirrored;
  const double weight = 1.0 / static_cast<double>(even.cols());
  const Outputs e = weight * (n.along_even * even + n.along_hidden * sum - along);
  const Outputs o = weight * (n.across_odd * odd + n.across_hidden * difference - across);
  const Hidden up = n.along_hidden.transpose() * e, side = n.across_hidden.transpose() * o;
  const Hidden back_here = (up + side).cwiseProduct((1.0 - here.array().square()).matrix());
  const Hidden back_mirrored = (up - side).cwiseProduct((1.0 - mirrored.array().square()).matrix());
  Network g;
  g.along_even.noalias() = e * even.transpose();
  g.across_odd.noalias() = o * odd.transpose();
  g.along_hidden.noalias() = e * sum.transpose();
  g.across_hidden.noalias() = o * difference.transpose();
  g.hidden_even.noalias() = (back_here + back_mirrored) * even.transpose();
  g.hidden_odd.noalias() = (back_here - back_mirrored) * odd.transpose();
  return g;
}

Network start_of(Random& random) {
  Network n;
  const double scale = 1.0 / std::sqrt(double(kEven + kOdd));
  for (double& x : n.hidden_even.reshaped()) x = scale * random.normal();
  for (double& x : n.hidden_odd.reshaped()) x = scale * random.normal();
  for (double& x : n.along_hidden.reshaped()) x = 0.1 * random.normal();
  for (double& x : n.across_hidden.reshaped()) x = 0.1 * random.normal();
  return n;
}

template <class Matrix, class Rows>
void copy(const Matrix& from, Rows& to) {
  for (std::size_t r = 0; r < to.size(); ++r)
    for (std::size_t c = 0; c < to[r].size(); ++c)
      to[r][c] = from(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
}

// Back to metres and seconds.
W weights_of(const Network& n, const Data& d) {
  const auto even = d.even_unit.cwiseInverse().asDiagonal();
  const auto odd = d.odd_unit.cwiseInverse().asDiagonal();
  const auto output = d.output_unit.asDiagonal();
  W w;
  copy((n.hidden_even * even).eval(), w.hidden_even);
  copy((n.hidden_odd * odd).eval(), w.hidden_odd);
  copy((output * n.along_hidden).eval(), w.along_hidden);
  copy((output * n.across_hidden).eval(), w.across_hidden);
  copy((output * n.along_even * even).eval(), w.along_even);
  copy((output * n.across_odd * odd).eval(), w.across_odd);
  return w;
}

}  // namespace

ShortTermWeights fit_network(const std::vector<ShortTermSample>& samples) {
  Random random(7);
  const Data data = data_of(samples);
  Network network = start_of(random);
  Adam<Network> adam(kDecay);
  Shuffled shuffled(samples.size(), random);
  for (int epoch = 0; epoch < kEpochs; ++epoch) {
    const std::vector<std::size_t>& order = shuffled.next();
    const double rate = kRate * (1.0 - double(epoch) / kEpochs);
    for (std::size_t from = 0; from + kBatch <= order.size(); from += kBatch) {
      const std::vector<std::size_t> batch(
          order.begin() + static_cast<std::ptrdiff_t>(from),
          order.begin() + static_cast<std::ptrdiff_t>(from + kBatch));
      Network gradient =
          gradient_of(network, data.even(Eigen::all, batch), data.odd(Eigen::all, batch),
                      data.along(Eigen::all, batch), data.across(Eigen::all, batch));
      adam.step(network, gradient, rate);
    }
  }
  return weights_of(network, data);
}

std::array<double, W::kOutputs> errors_left(const std::vector<ShortTermSample>& samples,
                                            const ShortTermWeights& weights) {
  std::array<double, W::kOutputs> sum{};
  for (const ShortTermSample& s : samples) {
    const ShortTermErrors said = short_term_errors(s.features, weights);
    for (int k = 0; k < W::kOutputs; ++k) sum[k] += (s.errors[k] - said[k]).squaredNorm();
  }
  for (double& x : sum) x = std::sqrt(x / static_cast<double>(samples.size()));
  return sum;
}

}  // namespace foretrack::bench
