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

/// p(t) = Σ_j row_j · t^j, t in [0, duration_s], world ENU (paper: p_i(t) = c_iᵀ β(t), s = 3).
struct QuinticPiece {
  double duration_s = 0.0;
  Eigen::Matrix<double, 6, 3> coefficients = Eigen::Matrix<double, 6, 3>::Zero();

  Vec3 position(double t) const { return derivative(t, 0); }
  Vec3 velocity(double t) const { return derivative(t, 1); }
  Vec3 acceleration(double t) const { return derivative(t, 2); }
  Vec3 jerk(double t) const { return derivative(t, 3); }
  /// The order-th derivative, order 0 … 5.
  Vec3 derivative(double t, int order) const;
};

struct AngleNode {
  double angle_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// An angle with constant acceleration between nodes dt_s apart; it holds after the last node. Not
/// wrapped between nodes (continuous).
struct AnglePlan {
  double dt_s = 0.1;
  std::vector<AngleNode> nodes;
  AngleNode at(double t_s) const;
};

/// Where p(t_k) sees z_k: the sector around the bisector from z_k (paper: V̂_k).
struct VisibleRegion {
  double time_s = 0.0;  // t_k after the trajectory's start
  Vec3 target_enu_m = Vec3::Zero();
  double bisector_rad = 0.0;
  double half_angle_rad = 0.0;
  Vec3 waypoint_enu_m = Vec3::Zero();
};

/// {x | A x ≤ b}: one row [aᵀ b] a half-space, a of unit length.
struct Polytope {
  std::vector<Eigen::Vector4d> planes;
  bool contains(const Vec3& p, double tolerance_m = 1e-9) const {
    for (const auto& plane : planes)
      if (plane.head<3>().dot(p) > plane[3] + tolerance_m) return false;
    return true;
  }
};

enum class PlanStatus : std::uint8_t {
  kNone,    // nothing to fly
  kFresh,   // this plan is new and passed the check
  kKept,    // the last checked trajectory and its stop tail fly on
  kSearch,  // new, checked, flies to where the lost target is believed to be
  kHold,    // stands still: no target, or nothing else is safe
};
enum class PlanReason : std::uint8_t {
  kOk,
  kNoTarget,
  kTargetLost,
  kStaleInput,
  kStartBlocked,   // the vehicle is inside an inflated obstacle
  kTargetBlocked,  // no free place sees the target
  kNoPath,
  kEmptyCorridor,
  kNotConverged,
  kLimitsViolated,
  kClearanceViolated,
  kDiscontinuous,
  kTailUnsafe,
  kTooNearTarget,
};
std::string_view to_string(PlanStatus status);
std::string_view to_string(PlanReason reason);

/// What is flown. Time runs from start_s. The last pieces, from tail_start_s on, are the stop tail:
/// they end at rest.
struct PlannedTrajectory {
  std::uint64_t id = 0;
  double stamp_s = 0.0;  // of the sensor data that caused it
  double start_s = 0.0;  // absolute time of t = 0
  std::vector<QuinticPiece> pieces;
  double tail_start_s = 0.0;  // t where the stop tail begins
  AnglePlan yaw;
  AnglePlan gimbal_pitch;  // empty without a gimbal
  std::vector<VisibleRegion> visible_regions;
  std::vector<Polytope> corridor;
  PlanStatus status = PlanStatus::kNone;
  PlanReason reason = PlanReason::kOk;

  double duration_s() const;
  /// Piece and local time at t; t is clamped to [0, duration]. Precondition: pieces not empty.
  std::pair<const QuinticPiece*, double> piece_at(double t_s) const;
  Vec3 position(double t_s) const;
  Vec3 velocity(double t_s) const;      // zero after the end
  Vec3 acceleration(double t_s) const;  // zero after the end
  Vec3 jerk(double t_s) const;          // zero after the end
};

}  // namespace foretrack
