// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/lbfgs.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kArmijo = 1.0e-4;
constexpr double kWolfe = 0.9;
constexpr int kDecreaseWindow = 3;
constexpr int kLineSearchEvaluations = 12;
constexpr double kNegligible = 1.0e-12;

/// H · gradient by the two-loop recursion, around the preconditioner scaled to the newest pair.
void find_direction(LbfgsState& s, const CostFunction& cost) {
  s.direction = -s.gradient;
  for (int i = 0; i < s.count; ++i) {
    auto& pair = s.pairs[(s.newest + kLbfgsMemory - i) % kLbfgsMemory];
    pair.factor = pair.step.dot(s.direction) / pair.curvature;
    s.direction -= pair.factor * pair.change;
  }
  cost.precondition(s.direction);
  if (s.count > 0) s.direction *= s.scale;
  for (int i = s.count - 1; i >= 0; --i) {
    const auto& pair = s.pairs[(s.newest + kLbfgsMemory - i) % kLbfgsMemory];
    const double factor = pair.change.dot(s.direction) / pair.curvature;
    s.direction += (pair.factor - factor) * pair.step;
  }
}

/// Keeps (s, y) of the accepted step, if it has positive curvature.
void remember(LbfgsState& s, const CostFunction& cost, double step) {
  auto& pair = s.pairs[(s.newest + 1) % kLbfgsMemory];
  pair.step = step * s.direction;
  pair.change = s.trial_gradient - s.gradient;
  pair.curvature = pair.step.dot(pair.change);
  s.direction = pair.change;
  cost.precondition(s.direction);
  const double size = pair.change.dot(s.direction);
  if (!(pair.curvature > kNegligible * size)) return;
  s.scale = pair.curvature / size;
  s.newest = (s.newest + 1) % kLbfgsMemory;
  s.count = std::min(s.count + 1, kLbfgsMemory);
}

/// The next step inside (low, high): where the parabola through both ends has its minimum, kept
/// away from the ends.
double interpolate(double low, double low_cost, double low_slope, double high, double high_cost) {
  const double width = high - low;
  const double bend = high_cost - low_cost - low_slope * width;
  const double at = bend > 0.0 ? -0.5 * low_slope * width / bend : 0.5;
  return low + width * (std::isfinite(at) ? std::clamp(at, 0.1, 0.9) : 0.1);
}

/// Along direction from x: a step that decreases enough and flattens the slope enough. Returns 0 if
/// no decrease was found; otherwise trial, trial_gradient and cost belong to the step.
double line_search(LbfgsState& s, CostFunction& function, const Variables& x, double step,
                   const LbfgsParams& params, LbfgsReport& report) {
  const double start_cost = report.cost, start_slope = s.gradient.dot(s.direction);
  if (!(start_slope < 0.0)) return 0.0;
  double low = 0.0, low_cost = start_cost, low_slope = start_slope, high = 0.0;
  const int last = std::min(report.evaluations + kLineSearchEvaluations, params.evaluations_max);
  while (report.evaluations < last) {
    s.trial = x + step * s.direction;
    const double cost = function.evaluate(s.trial, s.trial_gradient);
    ++report.evaluations;
    const double slope = s.trial_gradient.dot(s.direction);
    const bool decreases = cost <= start_cost + kArmijo * step * start_slope;
    const bool done = decreases && slope >= kWolfe * start_slope;
    if (done || (report.evaluations == last && cost < start_cost)) {
      report.cost = cost;
      return step;
    }
    if (decreases) {
      low = step, low_cost = cost, low_slope = slope;
      step = high > 0.0 ? 0.5 * (low + high) : 2.0 * step;
    } else {
      high = step;
      step = interpolate(low, low_cost, low_slope, high, cost);
    }
  }
  return 0.0;
}

/// The decrease over the last iterations, relative to the cost.
class DecreaseWindow {
 public:
  explicit DecreaseWindow(double cost) { costs_.fill(cost); }
  double push(double cost) {
    const double before = costs_[next_];
    costs_[next_] = cost;
    next_ = (next_ + 1) % kDecreaseWindow;
    ++pushed_;
    if (pushed_ < kDecreaseWindow) return 1.0;
    return (before - cost) / std::max(std::abs(cost), kNegligible);
  }

 private:
  std::array<double, kDecreaseWindow> costs_;
  int next_ = 0, pushed_ = 0;
};

double first_step(const LbfgsState& s, const LbfgsParams& params) {
  if (s.count > 0) return 1.0;
  return std::min(1.0, params.first_step_max / s.direction.lpNorm<Eigen::Infinity>());
}

}  // namespace

LbfgsReport minimize(LbfgsState& s, CostFunction& cost, Variables& x, const LbfgsParams& params) {
  LbfgsReport report;
  s.count = 0;
  s.gradient.resize(x.size());
  s.trial_gradient.resize(x.size());
  report.initial_cost = report.cost = cost.evaluate(x, s.gradient);
  report.evaluations = 1;
  if (!std::isfinite(report.cost) || !s.gradient.allFinite()) return report;
  DecreaseWindow window(report.cost);
  report.status = LbfgsStatus::kCountReached;
  while (report.iterations < params.iterations_max && report.evaluations < params.evaluations_max) {
    find_direction(s, cost);
    const double step = s.gradient.isZero(kNegligible)
                            ? 0.0
                            : line_search(s, cost, x, first_step(s, params), params, report);
    if (step == 0.0 && s.count > 0 && report.evaluations < params.evaluations_max) {
      s.count = 0;  // what is remembered misleads: begin anew from here
      continue;
    }
    if (step == 0.0) {
      if (report.evaluations < params.evaluations_max) report.status = LbfgsStatus::kConverged;
      break;
    }
    ++report.iterations;
    x = s.trial;
    remember(s, cost, step);
    s.gradient = s.trial_gradient;
    if (window.push(report.cost) < params.relative_decrease) {
      report.status = LbfgsStatus::kConverged;
      break;
    }
  }
  return report;
}

}  // namespace foretrack
