// SPDX-License-Identifier: Apache-2.0
// How far what is flown leaves what is planned, as measured: the tube that a plan's room is for.
// Planner and gate measure it each for themselves.
#pragma once

#include <array>

#include "core/common/trajectory.hpp"

namespace foretrack {

/// A running bound by planned speed and acceleration: the 99th percentile of the deviations so far,
/// those of late more than those of long ago. Before there are any, of a vehicle that follows well.
/// It grows with the speed, linearly between whole metres a second. Allocates and throws nothing.
class DeviationBound {
 public:
  DeviationBound();

  /// The vehicle is there at t after its plan's begin. That it is late or early on the path, by up
  /// to 0.15 s, is no way off it.
  void add(const PlannedTrajectory& plan, double t_s, const Vec3& position_enu_m);
  /// The vehicle is so far (m) from its plan, which is so fast (m/s) and accelerates so (m/s²).
  void add(double speed_m_s, double acceleration_m_s2, double deviation_m);
  /// At most so far from a plan of this kind, m.
  double bound_m(double speed_m_s, double acceleration_m_s2) const;
  /// The same, however it accelerates.
  double bound_m(double speed_m_s) const;

 private:
  static constexpr int kSpeeds = 4;         // 0, 1, 2, 3 m/s, and faster
  static constexpr int kAccelerations = 2;  // up to 2 m/s², and more
  using Bounds = std::array<double, kSpeeds>;

  std::array<Bounds, kAccelerations> bounds_m_;
};

}  // namespace foretrack
