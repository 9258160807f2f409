// SPDX-License-Identifier: Apache-2.0
// The independent check: whether a trajectory may be flown.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/planning/motion/keep_clear.hpp"

namespace foretrack {

/// What a trajectory must keep to be flown.
struct CheckParams {
  double vehicle_radius_m = 0.35;  ///< least distance to occupied or unknown space
  /// how far from a start too near to obstacles the way may stay too near
  double escape_reach_m = 1.0;
  double position_tolerance_m = 0.02;        ///< at joints
  double velocity_tolerance_m_s = 0.05;      ///< at joints
  double acceleration_tolerance_m_s2 = 0.2;  ///< at joints
  double yaw_tolerance_rad = 0.02;           ///< at joints
  double yaw_rate_tolerance_rad_s = 0.05;    ///< at joints
  double limit_tolerance = 1.0e-3;           ///< relative, of every limit
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(CheckParams& params);

/// What a trajectory is checked against.
struct CheckInputs {
  const GridMap& map;
  BoundaryState flown;                   // what is flown at the trajectory's start_s
  AngleNode flown_yaw;                   // the same, of yaw
  const BodyCourses* courses = nullptr;  // everybody who moves; null: not checked
  const GapParams* body = nullptr;       // with them
  Passable passable = Passable::kSeenFree;
};

/// The first fault that was found, if there is one, and where.
struct CheckResult {
  PlanReason reason = PlanReason::kOk;
  double failed_at_s = 0.0;  // t of the first fault found, after the trajectory's start
  double max_speed_m_s = 0.0;
  double max_acceleration_m_s2 = 0.0;
  double min_clearance_m = 0.0;  // the least seen, centimetre steps as in the map
  BodyGaps gaps;                 // to everybody who moves
  bool ok() const { return reason == PlanReason::kOk; }
};

/// Checks, in this order: continuity with what is flown and at joints, rest at the end
/// (kDiscontinuous); speed and acceleration by the roots of their squares' derivatives and the yaw
/// plan's rate and acceleration, exact for piecewise constant acceleration (kLimitsViolated);
/// distance to what is not passable, at points a quarter of a cell apart or as far as their
/// clearance proves (kClearanceViolated, or kTailUnsafe from tail_start_s on); the gaps to
/// everybody who moves, on a fixed time step, by measure_gaps() (kTooNearTarget, whoever it is). A
/// start nearer to obstacles than allowed is accepted as long as the clearance does not fall below
/// the start's before they are left, within escape_reach_m; an occupied cell is never accepted to
/// enter. Throws std::invalid_argument for a trajectory without pieces. Allocates nothing.
CheckResult check_trajectory(const PlannedTrajectory& trajectory, const CheckInputs& inputs,
                             const FlightLimits& limits, const CheckParams& params);

}  // namespace foretrack
