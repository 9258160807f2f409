// SPDX-License-Identifier: Apache-2.0
// The penalties of the optimisation (paper §V.C), each with its analytic gradient. A constraint G ≤
// 0 costs weight · max(G, 0)³.
#pragma once

#include "core/planning/optimize/minco.hpp"

namespace foretrack {

/// max(G, 0)³ and its derivative by G.
struct Hinge {
  double value, slope;
};
/// Zero up to g = 0.
inline Hinge cubed_hinge(double g) {
  if (g <= 0.0) return {0.0, 0.0};
  return {g * g * g, 3.0 * g * g};
}

/// The same, but linear from g = reach on: a target far away must pull, not outweigh all limits.
inline Hinge reaching_hinge(double g, double reach) {
  if (g <= reach) return cubed_hinge(g);
  const Hinge at_reach = cubed_hinge(reach);
  return {at_reach.value + at_reach.slope * (g - reach), at_reach.slope};
}

/// A penalty at one point.
struct PointPenalty {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};

/// A sector in the plane, seen from its apex.
struct Sector {
  Vec3 apex = Vec3::Zero();
  Vec2 bisector = Vec2::UnitX();  // unit
  double cos_half_angle = -1.0;
};
/// From the angles of its middle and of its half.
Sector make_sector(const Vec3& apex_enu_m, double bisector_rad, double half_angle_rad);

/// G_ν = cos θ − (p − z)·ξ / ‖p − z‖, horizontal.
void add_visibility(const Vec3& p, const Sector& sector, double weight, PointPenalty& sum);
/// G_dl = d_l − d_xy and G_du = d_xy − d_u; the latter linear from kFarReach_m on.
inline constexpr double kFarReach_m = 0.2;
/// G_dl = d_l − d_xy and G_du = d_xy − d_u, horizontal; the latter linear from kFarReach_m on.
void add_distance_band(const Vec3& p, const Vec3& target, double low_m, double high_m,
                       double weight, PointPenalty& sum);
/// |p_z − height| − band, linear from kFarReach_m on.
void add_height_band(const Vec3& p, double height_m, double band_m, double weight,
                     PointPenalty& sum);

/// An upright cylinder that stands on `foot`: somebody's body.
struct Pillar {
  Vec3 foot = Vec3::Zero();
  double radius_m = 0.25;
  double height_m = 1.75;
};
/// G = wanted gap − the gap in space between the vehicle's ball around p and the cylinder.
void add_gap(const Vec3& p, double ball_radius_m, const Pillar& pillar, double wanted_m,
             double weight, PointPenalty& sum);

/// What a whole piece is penalised for; limits are those at which the penalties begin.
struct PieceWeights {
  double corridor = 0.0, speed = 0.0, acceleration = 0.0;
  double corridor_margin_m = 0.0;
  double speed_limit_m_s = 0.0;
  double acceleration_limit_m_s2 = 0.0;
};

/// κ of the trapezoid rule.
inline constexpr int kQuadratureIntervals = 9;

/// Corridor, speed and acceleration penalties of one piece, (T/κ) Σ ω_j (…), and their partial
/// derivatives by the piece's junctions and duration. Returns the cost.
double add_piece_penalties(const Minco& minco, int piece, const Polytope& polytope,
                           const PieceWeights& weights, MincoGradient& gradient);

/// Where a time lies: p(t_k) = h(α) · Q of its piece.
struct PieceTime {
  int piece = 0;
  double start_s = 0.0;  // of the piece
  double alpha = 0.0;    // local time / duration, in [0, 1]
};
/// Moves on to a time that is not before the present one.
void advance(const Minco& minco, double time_s, PieceTime& at);
/// p at that time.
Vec3 position_at(const Minco& minco, const PieceTime& at);

/// Adds what a gradient by p(t_k) means for the junctions and the duration of its piece. Returns
/// its derivative by the duration of any earlier piece (a later local time: −gradient · velocity).
double add_position_gradient(const Minco& minco, const PieceTime& at, const Vec3& by_position,
                             MincoGradient& gradient);

}  // namespace foretrack
