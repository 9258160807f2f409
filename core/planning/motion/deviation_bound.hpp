// SPDX-License-Identifier: Apache-2.0
// How far what is flown leaves what is planned, as measured: the tube that a plan's room is for.
#pragma once

#include <array>

namespace foretrack {

/// A running bound by planned speed and acceleration: the 99th percentile of the deviations so far,
/// those of late more than those of long ago. Before there are any, of a vehicle that follows well.
class DeviationBound {
 public:
  DeviationBound();

  /// The vehicle is so far (m) from its plan, which is so fast (m/s) and accelerates so (m/s²).
  void add(double speed_m_s, double acceleration_m_s2, double deviation_m);
  /// At most so far from a plan of this kind, m.
  double bound_m(double speed_m_s, double acceleration_m_s2) const;

 private:
  static constexpr int kSpeeds = 4;         // up to 0.5, 1.5, 2.5 m/s, and faster
  static constexpr int kAccelerations = 2;  // up to 2 m/s², and more
  static std::size_t bin(double speed_m_s, double acceleration_m_s2);

  std::array<double, kSpeeds * kAccelerations> bounds_m_;
};

}  // namespace foretrack
