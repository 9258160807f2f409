// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/check_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/planning/motion/polynomial.hpp"

namespace foretrack {
namespace {

struct Checker {
  const PlannedTrajectory& trajectory;
  const CheckInputs& inputs;
  const FlightLimits& limits;
  const CheckParams& params;
  double duration_s;
  CheckResult result;

  /// The first fault found is the one that counts.
  void fault(PlanReason reason, double at_s) {
    if (!result.ok()) return;
    result.reason = reason;
    result.failed_at_s = at_s;
  }
  bool finite() const;
  void check_joints();
  void check_yaw();
  void check_limits();
  void check_clearance();
  void check_gaps();
  double time_to_move(double distance_m, double t) const;

 private:
  bool joins(const BoundaryState& before, const QuinticPiece& after) const;
};

BoundaryState state_at(const QuinticPiece& piece, double t) {
  return {piece.position(t), piece.velocity(t), piece.acceleration(t)};
}

bool Checker::finite() const {
  const auto finite_piece = [](const QuinticPiece& piece) {
    return std::isfinite(piece.duration_s) && piece.duration_s > 0.0 &&
           piece.coefficients.allFinite();
  };
  const auto finite_node = [](const AngleNode& node) {
    return std::isfinite(node.angle_rad) && std::isfinite(node.rate_rad_s);
  };
  return std::ranges::all_of(trajectory.pieces, finite_piece) &&
         std::ranges::all_of(trajectory.yaw.nodes, finite_node) && trajectory.yaw.dt_s > 0.0 &&
         std::isfinite(trajectory.tail_start_s);
}

bool Checker::joins(const BoundaryState& before, const QuinticPiece& after) const {
  const BoundaryState start = state_at(after, 0.0);
  return (start.position - before.position).norm() <= params.position_tolerance_m &&
         (start.velocity - before.velocity).norm() <= params.velocity_tolerance_m_s &&
         (start.acceleration - before.acceleration).norm() <= params.acceleration_tolerance_m_s2;
}

void Checker::check_joints() {
  BoundaryState before = inputs.flown;
  double start_s = 0.0;
  for (const QuinticPiece& piece : trajectory.pieces) {
    if (!joins(before, piece)) fault(PlanReason::kDiscontinuous, start_s);
    before = state_at(piece, piece.duration_s);
    start_s += piece.duration_s;
  }
  const bool at_rest = before.velocity.norm() <= params.velocity_tolerance_m_s &&
                       before.acceleration.norm() <= params.acceleration_tolerance_m_s2;
  if (!at_rest || trajectory.tail_start_s > duration_s)
    fault(PlanReason::kDiscontinuous, duration_s);
}

void Checker::check_yaw() {
  const AnglePlan& yaw = trajectory.yaw;
  if (yaw.nodes.empty()) return fault(PlanReason::kDiscontinuous, 0.0);
  const AngleNode& first = yaw.nodes.front();
  if (std::abs(wrap_angle(first.angle_rad - inputs.flown_yaw.angle_rad)) >
          params.yaw_tolerance_rad ||
      std::abs(first.rate_rad_s - inputs.flown_yaw.rate_rad_s) > params.yaw_rate_tolerance_rad_s)
    fault(PlanReason::kDiscontinuous, 0.0);
  const double rate_max = limits.yaw_rate_max_rad_s * (1.0 + params.limit_tolerance);
  const double change_max =
      limits.yaw_acceleration_max_rad_s2 * yaw.dt_s * (1.0 + params.limit_tolerance);
  for (std::size_t k = 0; k < yaw.nodes.size(); ++k) {
    const AngleNode& node = yaw.nodes[k];
    // The plan holds after its last node: there the rate drops to zero.
    const AngleNode next = k + 1 < yaw.nodes.size()
                               ? yaw.nodes[k + 1]
                               : AngleNode{node.angle_rad + 0.5 * node.rate_rad_s * yaw.dt_s, 0.0};
    const double t = yaw.dt_s * static_cast<double>(k);
    if (std::abs(node.rate_rad_s) > rate_max ||
        std::abs(next.rate_rad_s - node.rate_rad_s) > change_max)
      fault(PlanReason::kLimitsViolated, t);
    const double moved_rad = 0.5 * (node.rate_rad_s + next.rate_rad_s) * yaw.dt_s;
    if (std::abs(next.angle_rad - node.angle_rad - moved_rad) > params.yaw_tolerance_rad)
      fault(PlanReason::kDiscontinuous, t);
  }
}

void Checker::check_limits() {
  const Peak speed = peak_norm(trajectory.pieces, 1),
             acceleration = peak_norm(trajectory.pieces, 2);
  result.max_speed_m_s = speed.value;
  result.max_acceleration_m_s2 = acceleration.value;
  const double most = 1.0 + params.limit_tolerance;
  if (speed.value > most * limits.speed_max_m_s) fault(PlanReason::kLimitsViolated, speed.time_s);
  if (acceleration.value > most * limits.acceleration_max_m_s2)
    fault(PlanReason::kLimitsViolated, acceleration.time_s);
}

/// A time within which, from t on, the vehicle cannot move farther than the distance.
double Checker::time_to_move(double distance_m, double t) const {
  const double speed = trajectory.velocity(t).norm(), a = result.max_acceleration_m_s2;
  // v τ + a τ²/2 = distance, in the form without cancellation.
  const double by_acceleration =
      2.0 * distance_m / (speed + std::sqrt(speed * speed + 2.0 * a * distance_m));
  return std::max(by_acceleration, distance_m / std::max(result.max_speed_m_s, 1e-6));
}

/// Steps of a quarter of a cell, or as far as the clearance itself proves: it changes no faster
/// than the position does, but for the way from a point to its cell's centre.
void Checker::check_clearance() {
  const GridMap& map = inputs.map;
  const double half_cell_m = 0.5 * map.resolution_m, cell_diagonal_m = 1.7321 * map.resolution_m;
  const double step_m = 0.25 * map.resolution_m;
  const Vec3 start = trajectory.pieces.front().position(0.0);
  const double start_clearance_m = map.clearance_m(start, inputs.passable);
  bool escaping = start_clearance_m < params.vehicle_radius_m, may_be_occupied = escaping;
  result.min_clearance_m = start_clearance_m;
  for (double t = 0.0;;) {
    const Vec3 p = trajectory.position(t);
    const double clearance_m = map.clearance_m(p, inputs.passable);
    result.min_clearance_m = std::min(result.min_clearance_m, clearance_m);
    escaping = escaping && clearance_m < params.vehicle_radius_m;
    may_be_occupied = may_be_occupied && map.is_occupied(p);
    const bool enters_occupied = map.is_occupied(p) && !may_be_occupied;
    const bool enters_unfree = clearance_m <= 0.0 && start_clearance_m > 0.0;
    const bool escapes = escaping && !enters_unfree &&
                         clearance_m >= start_clearance_m - half_cell_m &&
                         (p - start).norm() <= params.escape_reach_m;
    if (enters_occupied || (clearance_m < params.vehicle_radius_m && !escapes))
      fault(t >= trajectory.tail_start_s ? PlanReason::kTailUnsafe : PlanReason::kClearanceViolated,
            t);
    if (t >= duration_s) break;
    // The distance grid does not know of the map's edge, beyond which nothing is free.
    const Vec3 from_low = p - map.origin_enu_m;
    const Vec3 from_high = map.resolution_m * map.size.cast<double>() - from_low;
    const double free_m = std::min({clearance_m - params.vehicle_radius_m - cell_diagonal_m,
                                    from_low.minCoeff(), from_high.minCoeff()});
    t = std::min(t + time_to_move(std::max(free_m, step_m), t), duration_s);
  }
}

void Checker::check_gaps() {
  if (inputs.courses == nullptr || inputs.body == nullptr) return;
  result.gaps = measure_gaps(trajectory, 0.0, *inputs.courses, limits, *inputs.body);
  if (!result.gaps.ok) fault(PlanReason::kTooNearTarget, result.gaps.least_at_s);
}

}  // namespace

CheckResult check_trajectory(const PlannedTrajectory& trajectory, const CheckInputs& inputs,
                             const FlightLimits& limits, const CheckParams& params) {
  if (trajectory.pieces.empty())
    throw std::invalid_argument("check_trajectory: the trajectory has no pieces");
  Checker checker{trajectory, inputs, limits, params, trajectory.duration_s(), {}};
  if (!checker.finite()) {
    checker.fault(PlanReason::kDiscontinuous, 0.0);
    return checker.result;
  }
  checker.check_joints();
  checker.check_yaw();
  checker.check_limits();
  checker.check_clearance();
  checker.check_gaps();
  return checker.result;
}

ParamRows rows(CheckParams& p) {
  return {
      {"vehicle_radius_m", &p.vehicle_radius_m, "m", 0.05, 2.0,
       "least distance to occupied or unknown space"},
      {"escape_reach_m", &p.escape_reach_m, "m", 0.0, 5.0,
       "how far from a start too near to obstacles the way may stay too near"},
      {"position_tolerance_m", &p.position_tolerance_m, "m", 0.0, 1.0, "at joints"},
      {"velocity_tolerance_m_s", &p.velocity_tolerance_m_s, "m/s", 0.0, 1.0, "at joints"},
      {"acceleration_tolerance_m_s2", &p.acceleration_tolerance_m_s2, "m/s2", 0.0, 5.0,
       "at joints"},
      {"yaw_tolerance_rad", &p.yaw_tolerance_rad, "rad", 0.0, 1.0, "at joints"},
      {"yaw_rate_tolerance_rad_s", &p.yaw_rate_tolerance_rad_s, "rad/s", 0.0, 1.0, "at joints"},
      {"limit_tolerance", &p.limit_tolerance, "", 0.0, 0.1, "relative, of every limit"},
  };
}

}  // namespace foretrack
