// SPDX-License-Identifier: Apache-2.0
#include "core/safety/check_motion.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

// Where pieces join, and where the last one ends.
constexpr double kJoint_m = 0.03, kJoint_m_s = 0.06, kJoint_m_s2 = 0.25, kJoint_rad = 0.03;
constexpr double kLimitTolerance = 1.0e-3;  // relative
constexpr double kAnchor_m = 1e6;           // farther away, positions are no places
constexpr int kHalvings = 10;

bool is_finite(const QuinticPiece& piece) {
  return piece.duration_s > 1e-6 && piece.duration_s < kMaxPlanDuration_s &&
         piece.coefficients.allFinite() && piece.position(0.0).norm() < kAnchor_m &&
         piece.position(piece.duration_s).norm() < kAnchor_m;
}

bool is_finite(const AngleNode& node) {
  return std::isfinite(node.angle_rad) && std::isfinite(node.rate_rad_s);
}

bool pieces_join(const QuinticPiece& a, const QuinticPiece& b) {
  const double end_s = a.duration_s;
  return (a.position(end_s) - b.position(0.0)).norm() <= kJoint_m &&
         (a.velocity(end_s) - b.velocity(0.0)).norm() <= kJoint_m_s &&
         (a.acceleration(end_s) - b.acceleration(0.0)).norm() <= kJoint_m_s2;
}

bool ends_at_rest(const QuinticPiece& last) {
  return last.velocity(last.duration_s).norm() <= kJoint_m_s &&
         last.acceleration(last.duration_s).norm() <= kJoint_m_s2;
}

bool yaw_is_continuous(const AnglePlan& yaw) {
  for (std::size_t k = 0; k + 1 < yaw.nodes.size(); ++k) {
    const double mean_rad_s = 0.5 * (yaw.nodes[k].rate_rad_s + yaw.nodes[k + 1].rate_rad_s);
    const double turned_rad = yaw.nodes[k + 1].angle_rad - yaw.nodes[k].angle_rad;
    if (std::abs(turned_rad - mean_rad_s * yaw.dt_s) > kJoint_rad) return false;
  }
  return true;
}

// Bernstein coefficients, on the piece, of the squared norm of its velocity or acceleration.
constexpr int kDegree = 8;
using Bernstein = std::array<double, kDegree + 1>;

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return value;
}

Bernstein squared_norm(const QuinticPiece& piece, int order) {
  const int degree = 5 - order;
  std::array<Vec3, 6> terms;  // of the derivative over time / duration
  double power = 1.0;
  for (int j = 0; j <= degree; ++j, power *= piece.duration_s) {
    double factor = power;
    for (int m = 0; m < order; ++m) factor *= j + order - m;
    terms[j] = factor * piece.coefficients.row(j + order).transpose();
  }
  Bernstein square{};  // by powers
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j) square[i + j] += terms[i].dot(terms[j]);
  Bernstein b{};
  for (int i = 0; i <= kDegree; ++i)
    for (int j = 0; j <= i; ++j) b[i] += binomial(i, j) / binomial(kDegree, j) * square[j];
  return b;
}

// The polynomial nowhere exceeds its coefficients, and has the first and the last one as values.
bool stays_below(const Bernstein& b, double most, int halvings) {
  if (*std::ranges::max_element(b) <= most) return true;
  if (b.front() > most || b.back() > most || halvings == 0) return false;
  Bernstein low{}, high = b;
  for (int i = 0; i <= kDegree; ++i) {
    low[i] = high[0];
    for (int j = 0; j < kDegree - i; ++j) high[j] = 0.5 * (high[j] + high[j + 1]);
  }
  return stays_below(low, most, halvings - 1) && stays_below(high, most, halvings - 1);
}

bool keeps(const PlannedTrajectory& plan, int order, double limit) {
  const double most = limit * (1.0 + kLimitTolerance);
  return std::ranges::all_of(plan.pieces, [&](const QuinticPiece& piece) {
    return stays_below(squared_norm(piece, order), most * most, kHalvings);
  });
}

}  // namespace

PlanFault check_shape(const PlannedTrajectory& plan) {
  if (plan.pieces.size() > kMaxPlanPieces || plan.yaw.nodes.size() > kMaxPlanNodes)
    return PlanFault::kTooLarge;
  const bool finite =
      std::ranges::all_of(plan.pieces, [](const QuinticPiece& p) { return is_finite(p); }) &&
      std::ranges::all_of(plan.yaw.nodes, [](const AngleNode& n) { return is_finite(n); }) &&
      plan.yaw.dt_s > 0.0 && std::isfinite(plan.yaw.dt_s + plan.start_s + plan.stamp_s);
  if (!finite) return PlanFault::kNotFinite;
  if (plan.duration_s() > kMaxPlanDuration_s) return PlanFault::kTooLarge;
  for (std::size_t i = 0; i + 1 < plan.pieces.size(); ++i)
    if (!pieces_join(plan.pieces[i], plan.pieces[i + 1])) return PlanFault::kBroken;
  if (plan.yaw.nodes.empty() || !yaw_is_continuous(plan.yaw)) return PlanFault::kBroken;
  return ends_at_rest(plan.pieces.back()) ? PlanFault::kNone : PlanFault::kEndsInMotion;
}

PlanFault check_limits(const PlannedTrajectory& plan, const MotionLimits& limits) {
  if (!keeps(plan, 1, limits.speed_m_s)) return PlanFault::kTooFast;
  if (!keeps(plan, 2, limits.acceleration_m_s2)) return PlanFault::kTooHard;
  const double most_rad_s = limits.yaw_rate_rad_s * (1.0 + kLimitTolerance);
  const bool slow = std::ranges::all_of(plan.yaw.nodes, [&](const AngleNode& node) {
    return std::abs(node.rate_rad_s) <= most_rad_s;
  });
  return slow ? PlanFault::kNone : PlanFault::kTurnsTooFast;
}

bool joins(const PlannedTrajectory& plan, const Joint& joint, const JointTolerance& tolerance) {
  const QuinticPiece& first = plan.pieces.front();
  const double turn_rad = plan.yaw.nodes.front().angle_rad - joint.yaw_rad;
  return (first.position(0.0) - joint.position_enu_m).norm() <= tolerance.position_m &&
         (first.velocity(0.0) - joint.velocity_enu_m_s).norm() <= tolerance.velocity_m_s &&
         (first.acceleration(0.0) - joint.acceleration_enu_m_s2).norm() <=
             tolerance.acceleration_m_s2 &&
         std::abs(wrap_angle(turn_rad)) <= tolerance.yaw_rad;
}

}  // namespace foretrack
