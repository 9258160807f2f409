// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/walk.hpp"

#include <algorithm>
#include <stdexcept>

namespace foretrack {
namespace {

// The polyline with what happens at each of its points.
struct WalkCorner {
  Vec2 point = Vec2::Zero();
  Vec2 out = Vec2::Zero();  // unit direction after it
  double half_sine = 0.0;   // of half the turning angle
  double speed_m_s = 0.0;   // on entering and leaving it
  double reach_m(double acceleration) const {
    return speed_m_s * speed_m_s * half_sine / acceleration;
  }
};

std::vector<WalkCorner> corners_of(std::span<const Vec2> route, const WalkLimits& limits) {
  std::vector<WalkCorner> corners;
  for (const Vec2& p : route)
    if (corners.empty() || (p - corners.back().point).norm() > 1e-6)
      corners.push_back({.point = p});
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    corners[i].out = (corners[i + 1].point - corners[i].point).normalized();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    WalkCorner& c = corners[i];
    c.half_sine = 0.5 * (c.out - corners[i - 1].out).norm();
    const double room_m = 0.5 * std::min((c.point - corners[i - 1].point).norm(),
                                         (corners[i + 1].point - c.point).norm());
    const double reach_m = std::min(limits.corner_reach_m, room_m);
    c.speed_m_s = std::min(limits.speed_m_s, std::sqrt(limits.acceleration_m_s2 * reach_m /
                                                       std::max(c.half_sine, 1e-9)));
  }
  return corners;
}

double straight_m(const WalkCorner& a, const WalkCorner& b, double acceleration) {
  return (b.point - a.point).norm() - a.reach_m(acceleration) - b.reach_m(acceleration);
}

// Lowers corner speeds until each can be reached from its neighbours (both end at rest).
void limit_speeds(std::vector<WalkCorner>& corners, double acceleration) {
  const auto limit = [&](const WalkCorner& from, WalkCorner& to) {
    const double length_m = std::max(0.0, straight_m(from, to, acceleration));
    const double reachable =
        std::sqrt(from.speed_m_s * from.speed_m_s + 2.0 * acceleration * length_m);
    to.speed_m_s = std::min(to.speed_m_s, reachable);
  };
  for (std::size_t i = 1; i < corners.size(); ++i) limit(corners[i - 1], corners[i]);
  for (std::size_t i = corners.size() - 1; i > 0; --i) limit(corners[i], corners[i - 1]);
}

// Appends pieces of constant acceleration.
struct Writer {
  Walk walk;
  Vec2 position_m;
  Vec2 velocity_m_s = Vec2::Zero();

  void add(double duration_s, const Vec2& acceleration) {
    if (duration_s < 1e-9) return;
    walk.pieces.push_back({walk.duration_s(),
                           duration_s,
                           {position_m, velocity_m_s, 0.5 * acceleration, Vec2::Zero()}});
    position_m += velocity_m_s * duration_s + 0.5 * duration_s * duration_s * acceleration;
    velocity_m_s += duration_s * acceleration;
  }
  // Straight on over length_m, from the present speed to `to`, as fast as the limits allow.
  void straight(double length_m, const Vec2& direction, double to, const WalkLimits& limits) {
    const double from = velocity_m_s.norm(), a = limits.acceleration_m_s2;
    const double peak =
        std::min(limits.speed_m_s, std::sqrt(a * length_m + 0.5 * (from * from + to * to)));
    const double ramps_m = (2.0 * peak * peak - from * from - to * to) / (2.0 * a);
    velocity_m_s = from * direction;
    add((peak - from) / a, a * direction);
    add((length_m - ramps_m) / peak, Vec2::Zero());
    add((peak - to) / a, -a * direction);
  }
};

// Second derivatives of a natural cubic spline at its knots (tridiagonal, Thomas's algorithm).
std::vector<Vec2> spline_curvatures(std::span<const TrackPoint> p) {
  const std::size_t n = p.size();
  std::vector<Vec2> m(n, Vec2::Zero());
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = p[i].time_s - p[i - 1].time_s, h1 = p[i + 1].time_s - p[i].time_s;
    const Vec2 right = 6.0 * ((p[i + 1].position_m - p[i].position_m) / h1 -
                              (p[i].position_m - p[i - 1].position_m) / h0);
    const double pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    m[i] = (right - h0 * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
  return m;
}

}  // namespace

WalkPoint Walk::at(double time_s) const {
  const auto next = std::upper_bound(pieces.begin(), pieces.end(), time_s,
                                     [](double t, const WalkPiece& p) { return t < p.start_s; });
  const WalkPiece& piece = next == pieces.begin() ? pieces.front() : *(next - 1);
  const double t = std::clamp(time_s - piece.start_s, 0.0, piece.duration_s);
  const auto& c = piece.coefficients_m;
  const Vec2 position = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  if (time_s < 0.0 || time_s >= duration_s()) return {.position_m = position};
  return {position, c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]), 2.0 * c[2] + 6.0 * t * c[3]};
}

Walk walk_along(std::span<const Vec2> route, const WalkLimits& limits) {
  if (route.empty()) throw std::invalid_argument("walk_along: the route has no points");
  auto corners = corners_of(route, limits);
  const double a = limits.acceleration_m_s2;
  limit_speeds(corners, a);
  Writer writer{.walk = {}, .position_m = corners[0].point};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const WalkCorner& next = corners[i + 1];
    writer.straight(std::max(0.0, straight_m(corners[i], next, a)), corners[i].out, next.speed_m_s,
                    limits);
    const Vec2 turn = next.speed_m_s * (next.out - corners[i].out);
    if (i + 2 < corners.size() && turn.norm() > 1e-12)
      writer.add(turn.norm() / a, a * turn.normalized());
  }
  if (writer.walk.pieces.empty())
    writer.walk.pieces.push_back(
        {.coefficients_m = {route[0], Vec2::Zero(), Vec2::Zero(), Vec2::Zero()}});
  return std::move(writer.walk);
}

Walk walk_through(std::span<const TrackPoint> p) {
  if (p.size() < 2) throw std::invalid_argument("walk_through: needs at least two points");
  for (std::size_t i = 1; i < p.size(); ++i)
    if (!(p[i].time_s > p[i - 1].time_s))
      throw std::invalid_argument("walk_through: times must increase");
  const auto m = spline_curvatures(p);
  Walk walk;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const double h = p[i + 1].time_s - p[i].time_s;
    const Vec2 slope =
        (p[i + 1].position_m - p[i].position_m) / h - h / 6.0 * (2.0 * m[i] + m[i + 1]);
    walk.pieces.push_back({p[i].time_s - p[0].time_s,
                           h,
                           {p[i].position_m, slope, 0.5 * m[i], (m[i + 1] - m[i]) / (6.0 * h)}});
  }
  return walk;
}

}  // namespace foretrack
