// SPDX-License-Identifier: Apache-2.0
// CPU time of one trajectory optimisation on random tracking problems.
// Usage: optimize_bench [problems]
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/planning/optimize/optimize_trajectory.hpp"
#include "services/common/time_now.hpp"
#include "tests/core/planning/random_problem.hpp"

namespace {

using namespace foretrack;

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

void run(const char* name, const RandomProblemOptions& options, int problems) {
  OptimizerState state;
  const OptimizerParams params;
  OptimizerParams exact = params;
  exact.relative_decrease = 1e-7, exact.iterations_max = 1000, exact.evaluations_max = 2000;
  std::vector<double> times_ms, evaluations, excess;
  int converged = 0;
  for (int i = 0; i < problems; ++i) {
    const OptimizationProblem problem = make_random_problem(i, options);
    const double start_ms = cpu_ms();
    const OptimizationResult& result = optimize_trajectory(state, problem, params);
    times_ms.push_back(cpu_ms() - start_ms);
    evaluations.push_back(result.evaluations);
    converged += result.status == OptimizationStatus::kConverged;
    const double cost = result.cost;
    excess.push_back(cost / optimize_trajectory(state, problem, exact).cost - 1.0);
  }
  std::printf(
      "%-22s CPU median %.3f p99 %.3f max %.3f ms | evaluations median %.0f p99 %.0f | converged "
      "%.1f %% | cost above the minimum's: median %.4f p95 %.4f\n",
      name, quantile(times_ms, 0.5), quantile(times_ms, 0.99), quantile(times_ms, 1.0),
      quantile(evaluations, 0.5), quantile(evaluations, 0.99), 100.0 * converged / problems,
      quantile(excess, 0.5), quantile(excess, 0.95));
}

}  // namespace

int main(int argc, char** argv) {
  const int problems = argc > 1 ? std::atoi(argv[1]) : 500;
  run("one path, 4-6 polytopes", {}, problems);
  run("three paths", {.paths = 3}, problems);
  run("one path, 12 polytopes", {.polytopes_min = 12, .polytopes_max = 12}, problems);
}
