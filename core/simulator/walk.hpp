// SPDX-License-Identifier: Apache-2.0
// How a person moves over the ground as a function of time: along a route with sharp corners, or as
// a recorded track went.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// A piece of a walk: p(t) = c0 + c1 t + c2 t² + c3 t³ on the ground plane, t counted from start_s.
struct WalkPiece {
  double start_s = 0.0;
  double duration_s = 0.0;
  /// c0 … c3, in m/s^k.
  std::array<Vec2, 4> coefficients_m{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

/// Place and motion at one time, on the ground plane, ENU.
struct WalkPoint {
  Vec2 position_m = Vec2::Zero();
  Vec2 velocity_m_s = Vec2::Zero();
  Vec2 acceleration_m_s2 = Vec2::Zero();
};

/// A way over the ground in time. It is continuous in position and velocity. Before its start and
/// after its end it rests.
struct Walk {
  std::vector<WalkPiece> pieces;  ///< one after the other, from time 0 on

  /// Until its end.
  double duration_s() const {
    return pieces.empty() ? 0.0 : pieces.back().start_s + pieces.back().duration_s;
  }
  /// Place and motion at a time. Precondition: there are pieces. Cost: logarithmic in them.
  WalkPoint at(double time_s) const;
};

/// What somebody who walks can do.
struct WalkLimits {
  double speed_m_s = 1.5;
  double acceleration_m_s2 = 3.0;  ///< of the velocity vector, so in turns too
  double corner_reach_m = 0.45;    ///< a corner is cut at most this far before and after it
};

/// Walks along a polyline, from rest at its first point to rest at its last one, as fast as the
/// limits allow. Between corners it keeps to the lines. At a corner the velocity turns with the
/// greatest acceleration (on a parabola), slowed down before as far as corner_reach_m asks for. One
/// point: stands there. Throws std::invalid_argument for an empty route.
Walk walk_along(std::span<const Vec2> route_m, const WalkLimits& limits);

/// Where somebody was at a time, on the ground plane.
struct TrackPoint {
  double time_s = 0.0;
  Vec2 position_m = Vec2::Zero();
};

/// Walks through all points in time: a natural cubic spline, so that the acceleration is
/// continuous. Its time starts at 0. Throws std::invalid_argument for fewer than two points or for
/// times that do not increase.
Walk walk_through(std::span<const TrackPoint> points);

}  // namespace foretrack
