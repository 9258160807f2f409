// SPDX-License-Identifier: Apache-2.0
// Stochastic gradient descent (Kingma and Ba 2015, "Adam"), seeded.
#pragma once

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/common/random.hpp"

namespace foretrack::bench {

/// Model::each(a, b, c, d, visit) visits the same parts of four models side by side.
template <class Model>
class Adam {
 public:
  explicit Adam(double decay) : decay_(decay) {}

  void step(Model& model, Model& gradient, double rate) {
    ++steps_;
    const double c1 = 1.0 - std::pow(0.9, steps_), c2 = 1.0 - std::pow(0.999, steps_);
    Model::each(model, gradient, first_, second_, [&](auto&& w, auto&& g, auto&& a, auto&& b) {
      g += decay_ * w;
      a = 0.9 * a + 0.1 * g;
      b = 0.999 * b + 0.001 * g.cwiseAbs2();
      w -= (rate * (a / c1).array() / ((b / c2).array().sqrt() + 1e-8)).matrix();
    });
  }

 private:
  Model first_, second_;
  double decay_;
  int steps_ = 0;
};

/// The numbers from 0 to count − 1, in another order each time.
class Shuffled {
 public:
  Shuffled(std::size_t count, Random& random) : order_(count), random_(random) {
    std::iota(order_.begin(), order_.end(), 0);
  }
  const std::vector<std::size_t>& next() {
    for (std::size_t i = order_.size(); i > 1; --i)
      std::swap(order_[i - 1], order_[random_.next() % i]);
    return order_;
  }

 private:
  std::vector<std::size_t> order_;
  Random& random_;
};

}  // namespace foretrack::bench
