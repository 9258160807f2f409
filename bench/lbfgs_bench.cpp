// SPDX-License-Identifier: Apache-2.0
// Our L-BFGS against liblbfgs on the same trajectory problems, costs and stopping rule. liblbfgs
// has no preconditioner; both start from the smoothed first guess. Usage: lbfgs_bench [problems]
#include <lbfgs.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/planning/optimize/trajectory_cost.hpp"
#include "services/common/time_now.hpp"
#include "tests/core/planning/random_problem.hpp"

namespace {

using namespace foretrack;

struct Outcome {
  double ms = 0.0, cost = 0.0;
  int evaluations = 0;
};

struct Counted : CostFunction {
  TrajectoryCost& cost;
  bool preconditioned;
  int evaluations = 0;
  Counted(TrajectoryCost& c, bool p) : cost(c), preconditioned(p) {}
  double evaluate(const Variables& x, Variables& gradient) override {
    ++evaluations;
    return cost.evaluate(x, gradient);
  }
  void precondition(Variables& direction) const override {
    if (preconditioned) cost.precondition(direction);
  }
};

Outcome run_ours(TrajectoryCost& cost, LbfgsState& state, const LbfgsParams& params,
                 bool preconditioned) {
  Counted counted(cost, preconditioned);
  Variables x = cost.first_guess();
  const double start_ms = cpu_ms();
  const LbfgsReport report = minimize(state, counted, x, params);
  return {cpu_ms() - start_ms, report.cost, counted.evaluations};
}

struct Instance {
  Counted counted;
  Variables x, gradient;
};

lbfgsfloatval_t evaluate(void* instance, const lbfgsfloatval_t* x, lbfgsfloatval_t* gradient, int n,
                         lbfgsfloatval_t) {
  auto& i = *static_cast<Instance*>(instance);
  i.x = Eigen::Map<const Eigen::VectorXd>(x, n);
  const double cost = i.counted.evaluate(i.x, i.gradient);
  Eigen::Map<Eigen::VectorXd>(gradient, n) = i.gradient;
  return cost;
}

Outcome run_liblbfgs(TrajectoryCost& cost, const LbfgsParams& params) {
  const Variables& guess = cost.first_guess();
  Instance instance{Counted(cost, false), guess, guess};
  lbfgs_parameter_t p;
  lbfgs_parameter_init(&p);
  p.m = kLbfgsMemory;
  p.past = 3;
  p.delta = params.relative_decrease;
  p.epsilon = 1e-9;
  p.max_iterations = params.iterations_max;
  std::vector<double> x(guess.data(), guess.data() + guess.size());
  Outcome outcome;
  const double start_ms = cpu_ms();
  lbfgs(static_cast<int>(x.size()), x.data(), &outcome.cost, evaluate, nullptr, &instance, &p);
  outcome.ms = cpu_ms() - start_ms;
  outcome.evaluations = instance.counted.evaluations;
  return outcome;
}

double median(std::vector<double> v) {
  std::ranges::sort(v);
  return v[v.size() / 2];
}

void print(const char* name, const std::vector<Outcome>& outcomes,
           const std::vector<double>& minima) {
  std::vector<double> ms, evaluations, excess;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    ms.push_back(outcomes[i].ms);
    evaluations.push_back(outcomes[i].evaluations);
    excess.push_back(outcomes[i].cost / minima[i] - 1.0);
  }
  std::printf("%-28s median: %.3f ms, %.0f evaluations, cost %.2f %% above the minimum\n", name,
              median(ms), median(evaluations), 100.0 * median(excess));
}

}  // namespace

int main(int argc, char** argv) {
  const int problems = argc > 1 ? std::atoi(argv[1]) : 300;
  const OptimizerParams defaults;
  const LbfgsParams params{defaults.relative_decrease, 1000, 2000}, exact{1e-8, 3000, 6000};
  std::vector<Outcome> ours, plain, library;
  std::vector<double> minima;
  LbfgsState state;
  TrajectoryCost cost;
  for (int i = 0; i < problems; ++i) {
    const OptimizationProblem problem = make_random_problem(i);
    cost.prepare(problem, defaults);
    ours.push_back(run_ours(cost, state, params, true));
    plain.push_back(run_ours(cost, state, params, false));
    library.push_back(run_liblbfgs(cost, params));
    minima.push_back(run_ours(cost, state, exact, true).cost);
  }
  print("ours", ours, minima);
  print("ours, not preconditioned", plain, minima);
  print("liblbfgs", library, minima);
}
