// SPDX-License-Identifier: Apache-2.0
#include "core/common/deviation_bound.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kShare = 0.99;
constexpr double kStep_m = 0.02;  // by which one greater deviation widens the bound
constexpr double kLeast_m = 0.03, kMost_m = 0.30;
constexpr double kFirstAtRest_m = 0.05, kFirstBySpeed_s = 0.03;  // before anything is measured
constexpr double kHard_m_s2 = 2.0;
constexpr double kLate_s = 0.15;

double beside_path_m(const Vec3& off_m, const Vec3& planned_velocity_m_s) {
  const double speed_m_s = planned_velocity_m_s.norm();
  if (speed_m_s < 1e-3) return off_m.norm();
  const Vec3 direction = planned_velocity_m_s / speed_m_s;
  const double late_m = std::clamp(off_m.dot(direction), -kLate_s * speed_m_s, kLate_s * speed_m_s);
  return (off_m - late_m * direction).norm();
}

}  // namespace

DeviationBound::DeviationBound() {
  for (Bounds& bounds : bounds_m_)
    for (int i = 0; i < kSpeeds; ++i) bounds[i] = kFirstAtRest_m + kFirstBySpeed_s * i;
}

void DeviationBound::add(const PlannedTrajectory& plan, double t_s, const Vec3& position_enu_m) {
  const Vec3 velocity = plan.velocity(t_s);
  add(velocity.norm(), plan.acceleration(t_s).norm(),
      beside_path_m(position_enu_m - plan.position(t_s), velocity));
}

// A quantile by stochastic approximation (Robbins and Monro 1951): at rest where a hundredth of the
// deviations is greater.
void DeviationBound::add(double speed_m_s, double acceleration_m_s2, double deviation_m) {
  if (!std::isfinite(speed_m_s + deviation_m)) return;
  const auto i = std::lround(std::clamp(speed_m_s, 0.0, kSpeeds - 1.0));
  double& bound_m = bounds_m_[acceleration_m_s2 > kHard_m_s2 ? 1 : 0][i];
  bound_m += kStep_m * (deviation_m > bound_m ? kShare : kShare - 1.0);
  bound_m = std::clamp(bound_m, kLeast_m, kMost_m);
}

double DeviationBound::bound_m(double speed_m_s, double acceleration_m_s2) const {
  const Bounds& bounds = bounds_m_[acceleration_m_s2 > kHard_m_s2 ? 1 : 0];
  const double at = std::clamp(speed_m_s, 0.0, kSpeeds - 1.0);
  double before_m = bounds[0], next_m = bounds[0];
  for (int i = 1; i - 1 < at; ++i) {
    before_m = next_m;
    next_m = std::max(next_m, bounds[i]);
  }
  const double share = at > 0.0 ? at - (std::ceil(at) - 1.0) : 0.0;
  return before_m + share * (next_m - before_m);
}

double DeviationBound::bound_m(double speed_m_s) const {
  return std::max(bound_m(speed_m_s, 0.0), bound_m(speed_m_s, 2.0 * kHard_m_s2));
}

}  // namespace foretrack
