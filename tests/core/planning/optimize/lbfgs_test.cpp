// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/lbfgs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace foretrack {
namespace {

struct Rosenbrock : CostFunction {
  double evaluate(const Variables& x, Variables& gradient) override {
    double sum = 0.0;
    gradient.setZero();
    for (int i = 0; i + 1 < x.size(); ++i) {
      const double a = 1.0 - x[i], b = x[i + 1] - x[i] * x[i];
      sum += a * a + 100.0 * b * b;
      gradient[i] += -2.0 * a - 400.0 * b * x[i];
      gradient[i + 1] += 200.0 * b;
    }
    return sum;
  }
};

/// Σ c_i x_i² with curvatures over eight decades.
struct Valley : CostFunction {
  bool preconditioned = false;
  static double curvature(int i) { return std::pow(10.0, i % 9); }
  double evaluate(const Variables& x, Variables& gradient) override {
    double sum = 0.0;
    for (int i = 0; i < x.size(); ++i) {
      sum += 0.5 * curvature(i) * x[i] * x[i];
      gradient[i] = curvature(i) * x[i];
    }
    return sum;
  }
  void precondition(Variables& direction) const override {
    if (!preconditioned) return;
    for (int i = 0; i < direction.size(); ++i) direction[i] /= curvature(i);
  }
};

/// −log x + x, infinite for x ≤ 0.
struct Barrier : CostFunction {
  double evaluate(const Variables& x, Variables& gradient) override {
    double sum = 0.0;
    for (int i = 0; i < x.size(); ++i) {
      sum += x[i] > 0.0 ? x[i] - std::log(x[i]) : std::numeric_limits<double>::infinity();
      gradient[i] = 1.0 - 1.0 / x[i];
    }
    return sum;
  }
};

const LbfgsParams kExact{1e-14, 500, 1000, 0.5};

TEST(Lbfgs, FindsTheMinimumOfRosenbrock) {
  LbfgsState state;
  Rosenbrock cost;
  Variables x = Variables::Constant(20, -1.2);
  const LbfgsReport report = minimize(state, cost, x, kExact);
  EXPECT_EQ(report.status, LbfgsStatus::kConverged);
  EXPECT_LT((x - Variables::Ones(20)).norm(), 1e-4);
  EXPECT_LT(report.evaluations, 250);
}

TEST(Lbfgs, PreconditionerMakesAnIllConditionedValleyEasy) {
  LbfgsState state;
  Valley cost;
  const auto evaluations = [&](bool preconditioned) {
    cost.preconditioned = preconditioned;
    Variables x = Variables::Ones(30);
    return minimize(state, cost, x, {1e-12, 500, 2000, 10.0}).evaluations;
  };
  EXPECT_LT(evaluations(true), 8);
  EXPECT_GT(evaluations(false), 40);
}

TEST(Lbfgs, StepsBackWhereTheCostIsInfinite) {
  LbfgsState state;
  Barrier cost;
  Variables x = Variables::Constant(3, 5.0);
  const LbfgsReport report = minimize(state, cost, x, {1e-12, 100, 200, 100.0});
  EXPECT_EQ(report.status, LbfgsStatus::kConverged);
  EXPECT_LT((x - Variables::Ones(3)).norm(), 1e-4);
}

TEST(Lbfgs, SaysThatAFirstGuessIsNotFinite) {
  LbfgsState state;
  Barrier cost;
  Variables x = Variables::Constant(3, -1.0);
  EXPECT_EQ(minimize(state, cost, x, kExact).status, LbfgsStatus::kNotFinite);
  EXPECT_EQ(x, Variables::Constant(3, -1.0));
}

TEST(Lbfgs, NeverExceedsItsCounts) {
  LbfgsState state;
  Rosenbrock cost;
  for (int most = 1; most < 30; ++most) {
    Variables x = Variables::Constant(8, -1.2), unused(8);
    const LbfgsReport report = minimize(state, cost, x, {0.0, 10, most, 0.5});
    EXPECT_LE(report.evaluations, most);
    EXPECT_LE(report.iterations, 10);
    EXPECT_EQ(report.status, LbfgsStatus::kCountReached);
    EXPECT_EQ(report.cost, cost.evaluate(x, unused));
    EXPECT_LE(report.cost, report.initial_cost);
  }
}

}  // namespace
}  // namespace foretrack
