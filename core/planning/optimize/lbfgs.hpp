// SPDX-License-Identifier: Apache-2.0
// Limited-memory BFGS with a weak-Wolfe line search, for small smooth problems solved often.
#pragma once

#include <array>

#include "core/common/geometry.hpp"

namespace foretrack {

inline constexpr int kMaxVariables = 160;
inline constexpr int kLbfgsMemory = 12;

/// Storage for kMaxVariables inside: resizing allocates nothing.
using Variables = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxVariables, 1>;

/// What is minimised: a value and its gradient at a point.
struct CostFunction {
  virtual ~CostFunction() = default;
  /// The cost at x; writes its gradient (of x's size).
  virtual double evaluate(const Variables& x, Variables& gradient) = 0;
  /// Multiplies by a symmetric, positive definite guess of the inverse Hessian, in place.
  virtual void precondition(Variables& direction) const { (void)direction; }
};

/// When to stop, and how long a memory to keep.
struct LbfgsParams {
  double relative_decrease = 1.0e-3;  // over kDecreaseWindow iterations, of the cost
  int iterations_max = 60;
  int evaluations_max = 90;
  double first_step_max = 0.5;  // of any variable, while nothing is known of the curvature
};

/// Why it stopped.
enum class LbfgsStatus {
  kConverged,     // the decrease, the gradient, or what a line search can still gain is negligible
  kCountReached,  // iterations or evaluations used up
  kNotFinite,     // no finite cost at the first guess
};

/// How a minimisation went.
struct LbfgsReport {
  LbfgsStatus status = LbfgsStatus::kNotFinite;
  int iterations = 0;
  int evaluations = 0;
  double initial_cost = 0.0;
  double cost = 0.0;
};

/// Kept between calls for its storage only: results do not depend on earlier calls.
struct LbfgsState {
  /// A step and the change of the gradient along it.
  struct Pair {
    Variables step, change;  // s, y
    double curvature = 0.0;  // s·y
    double factor = 0.0;     // of the two-loop recursion
  };
  std::array<Pair, kLbfgsMemory> pairs;
  int newest = 0, count = 0;
  double scale = 1.0;  // of the preconditioner, from the newest pair
  Variables gradient, direction, trial, trial_gradient;
};

/// Minimises from x, in place; x ends at the best point seen. The cost may be infinite or NaN away
/// from the first guess: the line search steps back. Never more than evaluations_max evaluations.
/// Source: Nocedal and Wright, Numerical Optimization, alg. 7.4; Lewis and Overton (2013) for the
/// bracketing.
LbfgsReport minimize(LbfgsState& state, CostFunction& cost, Variables& x,
                     const LbfgsParams& params);

}  // namespace foretrack
