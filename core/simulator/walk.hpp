// SPDX-License-Identifier: Apache-2.0
// How a person moves over the ground as a function of time: along a route with sharp corners, or as
// a recorded track went.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// p(t) = c0 + c1 t + c2 t² + c3 t³ on the ground plane, t from start_s.
struct WalkPiece {
  double start_s = 0.0;
  double duration_s = 0.0;
  std::array<Vec2, 4> coefficients_m{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

struct WalkPoint {
  Vec2 position_m = Vec2::Zero();
  Vec2 velocity_m_s = Vec2::Zero();
  Vec2 acceleration_m_s2 = Vec2::Zero();
};

/// Continuous in position and velocity. Before its start and after its end it rests.
struct Walk {
  std::vector<WalkPiece> pieces;

  double duration_s() const {
    return pieces.empty() ? 0.0 : pieces.back().start_s + pieces.back().duration_s;
  }
  /// Precondition: not empty. Cost: logarithmic in the pieces.
  WalkPoint at(double time_s) const;
};

struct WalkLimits {
  double speed_m_s = 1.5;
  double acceleration_m_s2 = 3.0;  // of the velocity vector
  double corner_reach_m = 0.45;    // a corner is cut at most this far before and after it
};

/// From rest at the first point to rest at the last one. Between corners it keeps the route's
/// lines; at a corner the velocity turns at the acceleration limit (a parabola), slowed before as
/// far as corner_reach_m asks. One point: stands there. Throws std::invalid_argument for an empty
/// route.
Walk walk_along(std::span<const Vec2> route_m, const WalkLimits& limits);

struct TrackPoint {
  double time_s = 0.0;
  Vec2 position_m = Vec2::Zero();
};

/// A natural cubic spline (continuous acceleration) through the points. Time starts at 0. Throws
/// std::invalid_argument for fewer than two points or times that do not increase.
Walk walk_through(std::span<const TrackPoint> points);

}  // namespace foretrack
