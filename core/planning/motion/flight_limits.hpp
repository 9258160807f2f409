// SPDX-License-Identifier: Apache-2.0
// What the vehicle may do, and the states at which pieces of its motion join.
#pragma once

#include "core/common/params.hpp"
#include "core/common/trajectory.hpp"

namespace foretrack {

/// Shared by the optimiser, the stop tail, the yaw plan and the check. Defaults: paper §VI.
struct FlightLimits {
  double speed_max_m_s = 3.0;                ///< greatest speed
  double acceleration_max_m_s2 = 5.0;        ///< greatest acceleration
  double yaw_rate_max_rad_s = 2.0;           ///< greatest yaw rate
  double yaw_acceleration_max_rad_s2 = 6.0;  ///< greatest yaw acceleration
};
/// Of the limits, in plans: what is flown swings over what is planned, by 5 to 7 % (simulated).
inline constexpr double kPlannedShare = 0.93;
/// One row for each field: name, unit, range, meaning.
ParamRows rows(FlightLimits& limits);

/// World ENU.
struct BoundaryState {
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 acceleration = Vec3::Zero();
};

}  // namespace foretrack
