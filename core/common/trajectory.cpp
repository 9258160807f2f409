// SPDX-License-Identifier: Apache-2.0
#include "core/common/trajectory.hpp"

#include <algorithm>

namespace foretrack {

Vec3 QuinticPiece::derivative(double t, int order) const {
  // Horner's scheme on the coefficients times the falling factorial j (j−1) … (j−order+1).
  Vec3 value = Vec3::Zero();
  for (int j = 5; j >= order; --j) {
    double factor = 1.0;
    for (int m = 0; m < order; ++m) factor *= j - m;
    value = value * t + factor * coefficients.row(j).transpose();
  }
  return value;
}

AngleNode AnglePlan::at(double t_s) const {
  if (nodes.empty()) return {};
  const double last_s = dt_s * static_cast<double>(nodes.size() - 1);
  if (nodes.size() == 1 || t_s >= last_s) return {nodes.back().angle_rad, 0.0};
  const double clamped_s = std::max(t_s, 0.0);
  const auto k = std::min(static_cast<std::size_t>(clamped_s / dt_s), nodes.size() - 2);
  const double u = clamped_s - dt_s * static_cast<double>(k);
  const double acceleration = (nodes[k + 1].rate_rad_s - nodes[k].rate_rad_s) / dt_s;
  return {nodes[k].angle_rad + nodes[k].rate_rad_s * u + 0.5 * acceleration * u * u,
          nodes[k].rate_rad_s + acceleration * u};
}

std::string_view to_string(PlanStatus status) {
  constexpr std::array<std::string_view, 5> names = {"none", "fresh", "kept", "search", "hold"};
  return names.at(static_cast<std::size_t>(status));
}

std::string_view to_string(PlanReason reason) {
  constexpr std::array<std::string_view, 11> names = {"ok",
                                                      "no target",
                                                      "target lost",
                                                      "stale input",
                                                      "empty corridor",
                                                      "not converged",
                                                      "limits violated",
                                                      "clearance violated",
                                                      "discontinuous",
                                                      "stop tail unsafe",
                                                      "too near the target"};
  return names.at(static_cast<std::size_t>(reason));
}

double PlannedTrajectory::duration_s() const {
  double sum = 0.0;
  for (const auto& piece : pieces) sum += piece.duration_s;
  return sum;
}

std::pair<const QuinticPiece*, double> PlannedTrajectory::piece_at(double t_s) const {
  double local_s = std::max(t_s, 0.0);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    if (local_s < pieces[i].duration_s) return {&pieces[i], local_s};
    local_s -= pieces[i].duration_s;
  }
  return {&pieces.back(), std::min(local_s, pieces.back().duration_s)};
}

Vec3 PlannedTrajectory::position(double t_s) const {
  const auto [piece, local_s] = piece_at(t_s);
  return piece->position(local_s);
}
Vec3 PlannedTrajectory::velocity(double t_s) const {
  if (t_s > duration_s()) return Vec3::Zero();
  const auto [piece, local_s] = piece_at(t_s);
  return piece->velocity(local_s);
}
Vec3 PlannedTrajectory::acceleration(double t_s) const {
  if (t_s > duration_s()) return Vec3::Zero();
  const auto [piece, local_s] = piece_at(t_s);
  return piece->acceleration(local_s);
}
Vec3 PlannedTrajectory::jerk(double t_s) const {
  if (t_s > duration_s()) return Vec3::Zero();
  const auto [piece, local_s] = piece_at(t_s);
  return piece->jerk(local_s);
}

}  // namespace foretrack
