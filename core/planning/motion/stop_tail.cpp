// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/stop_tail.hpp"

#include <algorithm>
#include <limits>

#include "core/planning/motion/polynomial.hpp"

namespace foretrack {
namespace {

constexpr int kCandidates = 24;
constexpr double kGrowth = 1.15;

/// Least jerk to rest with a free end point: the fifth derivative vanishes, the velocity is the
/// cubic from (v, a) to (0, 0).
QuinticPiece quartic_stop(const BoundaryState& from, double duration_s) {
  const double t1 = 1.0 / duration_s, t2 = t1 * t1;
  QuinticPiece piece;
  piece.duration_s = duration_s;
  auto& c = piece.coefficients;
  c.row(0) = from.position;
  c.row(1) = from.velocity;
  c.row(2) = 0.5 * from.acceleration;
  c.row(3) = -t2 * from.velocity - (2.0 / 3.0 * t1) * from.acceleration;
  c.row(4) = (0.5 * t2 * t1) * from.velocity + (0.25 * t2) * from.acceleration;
  return piece;
}

}  // namespace

StopTail make_stop_tail(const BoundaryState& from, const FlightLimits& limits,
                        double min_duration_s) {
  // Without initial acceleration the peak deceleration is 1.5 ‖v‖ / T.
  double duration_s =
      std::max(min_duration_s, 1.2 * from.velocity.norm() / limits.acceleration_max_m_s2);
  StopTail best;
  double least_excess = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kCandidates; ++i, duration_s *= kGrowth) {
    StopTail tail{quartic_stop(from, duration_s), false, 0.0, 0.0};
    tail.max_speed_m_s = peak_norm({&tail.piece, 1}, 1).value;
    tail.max_acceleration_m_s2 = peak_norm({&tail.piece, 1}, 2).value;
    const double excess = std::max(tail.max_speed_m_s / limits.speed_max_m_s,
                                   tail.max_acceleration_m_s2 / limits.acceleration_max_m_s2);
    tail.within_limits = excess <= 1.0;
    if (excess < least_excess) {
      least_excess = excess;
      best = tail;
    }
    if (tail.within_limits) break;
  }
  return best;
}

}  // namespace foretrack
