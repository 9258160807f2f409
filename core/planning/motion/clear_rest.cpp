// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/clear_rest.hpp"

#include <algorithm>

namespace foretrack {

bool rest_is_clear(const GridMap& map, const PlannedTrajectory& trajectory, double t_s,
                   double required_m, Passable passable) {
  double allowed_m = std::min(required_m, map.clearance_m(trajectory.position(t_s), passable));
  double begin_s = 0.0;
  for (const QuinticPiece& piece : trajectory.pieces) {
    const double from_s = std::max(t_s - begin_s, 0.0);
    begin_s += piece.duration_s;
    if (from_s >= piece.duration_s) continue;
    // By speed: half a cell a step, and some steps even when it hardly moves.
    for (double at_s = from_s;; at_s = std::min(at_s, piece.duration_s)) {
      const double clearance_m = map.clearance_m(piece.position(at_s), passable);
      if (clearance_m < allowed_m) return false;
      allowed_m = std::max(allowed_m, std::min(required_m, clearance_m));
      if (at_s >= piece.duration_s) break;
      const double speed_m_s = std::max(piece.velocity(at_s).norm(), 0.5);
      at_s += std::clamp(0.4 * map.resolution_m / speed_m_s, 0.005, 0.1);
    }
  }
  return true;
}

}  // namespace foretrack
