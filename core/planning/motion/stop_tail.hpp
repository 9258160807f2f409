// SPDX-License-Identifier: Apache-2.0
// The stop: from any moving state to rest.
#pragma once

#include "core/planning/motion/flight_limits.hpp"

namespace foretrack {

/// A piece that ends at rest.
struct StopTail {
  QuinticPiece piece;  // ends with no velocity and no acceleration
  bool within_limits = false;
  double max_speed_m_s = 0.0;
  double max_acceleration_m_s2 = 0.0;
};

/// The least-jerk stop with a free end point (a quartic), the shortest of a few durations that
/// keeps the speed and acceleration limits exactly. A state that breaks the limits itself has no
/// such stop: then the one with the least excess, within_limits = false. A state at rest stays for
/// a moment (min_duration_s). Also the emergency stop. Cost: a few microseconds.
StopTail make_stop_tail(const BoundaryState& from, const FlightLimits& limits,
                        double min_duration_s = 0.2);

}  // namespace foretrack
