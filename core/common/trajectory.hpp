// SPDX-License-Identifier: Apache-2.0
// Piecewise quintic trajectories, angle plans, and the planned trajectory that is published and
// flown.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// One piece of a trajectory: p(t) = Σ_j row_j · t^j for t in [0, duration_s], world ENU (paper
/// §V: p_i(t) = c_iᵀ β(t) with s = 3, so of fifth order).
struct QuinticPiece {
  double duration_s = 0.0;
  /// Row j is the coefficient of t^j, in m/s^j.
  Eigen::Matrix<double, 6, 3> coefficients = Eigen::Matrix<double, 6, 3>::Zero();

  Vec3 position(double t) const { return derivative(t, 0); }      ///< m
  Vec3 velocity(double t) const { return derivative(t, 1); }      ///< m/s
  Vec3 acceleration(double t) const { return derivative(t, 2); }  ///< m/s²
  Vec3 jerk(double t) const { return derivative(t, 3); }          ///< m/s³
  /// The order-th derivative at t, order 0 to 5. t is not clamped to the piece.
  Vec3 derivative(double t, int order) const;
};

/// An angle and its rate at one moment.
struct AngleNode {
  double angle_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// An angle over time: nodes dt_s apart, and constant angular acceleration between them. The angle
/// is continuous, so it may be beyond ±π.
struct AnglePlan {
  double dt_s = 0.1;
  std::vector<AngleNode> nodes;  ///< node k is at k · dt_s; empty: no plan
  /// At t_s. Before the first node: as at it. After the last node: its angle, at rest. Without
  /// nodes: zero.
  AngleNode at(double t_s) const;
};

/// From where the vehicle sees the target at one sample of time: the sector with its corner at the
/// target z_k, around a bisector (paper §V: V̂_k).
struct VisibleRegion {
  double time_s = 0.0;                 ///< t_k, after the trajectory's start
  Vec3 target_enu_m = Vec3::Zero();    ///< z_k, where the target is expected then
  double bisector_rad = 0.0;           ///< from the target outwards, ENU
  double half_angle_rad = 0.0;         ///< of the sector, to either side of the bisector
  Vec3 waypoint_enu_m = Vec3::Zero();  ///< the place in the sector that was aimed for
};

/// The convex set {x | A x ≤ b}.
struct Polytope {
  std::vector<Eigen::Vector4d> planes;  ///< a row [aᵀ b] for each half-space, a of unit length
  /// True if the point is in every half-space, or out by at most the tolerance.
  bool contains(const Vec3& p, double tolerance_m = 1e-9) const {
    for (const auto& plane : planes)
      if (plane.head<3>().dot(p) > plane[3] + tolerance_m) return false;
    return true;
  }
};

/// What is flown.
enum class PlanStatus : std::uint8_t {
  kNone,    ///< nothing to fly
  kFresh,   ///< this plan is new and passed the check
  kKept,    ///< the last checked trajectory and its stop tail fly on
  kSearch,  ///< new, checked, flies to where the lost target is believed to be
  kHold,    ///< stands still: no target, or nothing else is safe
};
/// Why it is not something better.
enum class PlanReason : std::uint8_t {
  kOk,
  kNoTarget,
  kTargetLost,
  kStaleInput,
  kEmptyCorridor,
  kNotConverged,
  kLimitsViolated,
  kClearanceViolated,
  kDiscontinuous,
  kTailUnsafe,
  kTooNearTarget,
};
/// For logs and displays.
std::string_view to_string(PlanStatus status);
/// For logs and displays.
std::string_view to_string(PlanReason reason);

/// What is flown. Time t runs from start_s. The last pieces, from tail_start_s on, are the stop
/// tail: they end at rest, so that the vehicle can fly the trajectory to its end whatever happens.
struct PlannedTrajectory {
  std::uint64_t id = 0;  ///< grows with each new trajectory; 0: none
  double stamp_s = 0.0;  ///< of the target's state that it was planned for
  double start_s = 0.0;  ///< absolute time of t = 0
  std::vector<QuinticPiece> pieces;
  double tail_start_s = 0.0;                   ///< t where the stop tail begins
  AnglePlan yaw;                               ///< of the body, ENU
  AnglePlan gimbal_pitch;                      ///< empty without a gimbal
  std::vector<VisibleRegion> visible_regions;  ///< one for each sample of time
  std::vector<Polytope> corridor;              ///< free of obstacles; pieces fly inside
  PlanStatus status = PlanStatus::kNone;
  PlanReason reason = PlanReason::kOk;

  /// Sum over the pieces.
  double duration_s() const;
  /// The piece at t, and the time since its beginning. t is clamped to [0, duration]. Precondition:
  /// there are pieces, as for all that follow. Cost: linear in the pieces.
  std::pair<const QuinticPiece*, double> piece_at(double t_s) const;
  Vec3 position(double t_s) const;      ///< m; after the end: where it ends
  Vec3 velocity(double t_s) const;      ///< m/s; zero after the end
  Vec3 acceleration(double t_s) const;  ///< m/s²; zero after the end
  Vec3 jerk(double t_s) const;          ///< m/s³; zero after the end
};

}  // namespace foretrack
