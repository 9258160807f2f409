// SPDX-License-Identifier: Apache-2.0
// Whether a plan can be flown at all: its shape, its limits, and what it joins.
#pragma once

#include "core/common/trajectory.hpp"
#include "core/safety/plan_fault.hpp"

namespace foretrack {

inline constexpr std::size_t kMaxPlanPieces = 64, kMaxPlanNodes = 512;
inline constexpr double kMaxPlanDuration_s = 60.0;

/// What a flown trajectory must not exceed.
struct MotionLimits {
  double speed_m_s = 3.0;
  double acceleration_m_s2 = 5.0;
  double yaw_rate_rad_s = 2.0;
};

/// Sizes, finite numbers, pieces that join within centimetres and that end at rest, a yaw without
/// jumps. Precondition: there are pieces.
PlanFault check_shape(const PlannedTrajectory& plan);

/// The limits at every instant, not at samples: a bound of the squared norms' Bernstein
/// coefficients, halved where it does not tell (Farouki 2012), with a tolerance of 0.1 % of the
/// limit; yaw rates are linear between nodes. Precondition: check_shape() passed.
PlanFault check_limits(const PlannedTrajectory& plan, const MotionLimits& limits);

/// What a plan may join. World ENU.
struct Joint {
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  double yaw_rad = 0.0;
};
/// How far a plan may be from what it joins.
struct JointTolerance {
  double position_m = 0.0;
  double velocity_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double yaw_rad = 0.0;
};
/// Whether the plan goes on from the joint.
bool joins(const PlannedTrajectory& plan, const Joint& joint, const JointTolerance& tolerance);

}  // namespace foretrack
