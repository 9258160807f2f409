// SPDX-License-Identifier: Apache-2.0
// MINCO, s = 3 (paper §V.B): the least-jerk trajectory through given waypoints in given durations,
// and the gradients that it passes on.
//
// The unknowns are velocity and acceleration at the inner junctions: a symmetric, positive
// definite, block-tridiagonal system of 2 × 2 blocks, a sixth of the coefficients' band matrix. At
// its solution jerk and snap are continuous too, which is MINCO's condition of optimality.
#pragma once

#include <array>

#include "core/planning/motion/flight_limits.hpp"
#include "core/planning/optimize/quintic_basis.hpp"

namespace foretrack {

/// Most pieces of one trajectory; everything is allocated for that many at once.
inline constexpr int kMaxPieces = 40;

/// Rows: position, velocity, acceleration.
using Junction = Eigen::Matrix3d;

/// A least-jerk trajectory by its junctions and durations.
struct Minco {
  int pieces = 0;
  std::array<double, kMaxPieces> durations_s;
  /// Junction i starts piece i. The first and the last are given whole, of the others the
  /// positions; solve() fills in their velocities and accelerations.
  std::array<Junction, kMaxPieces + 1> junctions;
  /// Factors of the system, kept for the adjoint.
  std::array<Eigen::Matrix2d, kMaxPieces + 1> pivot_inverses, gains;
};

/// Sets both ends, for this many pieces; junctions and durations are then to be filled.
void set_ends(Minco& minco, const BoundaryState& start, const BoundaryState& goal, int pieces);

/// Velocities and accelerations from positions and durations: c = M(q, T). Cost: linear in pieces.
void solve(Minco& minco);

/// Partial derivatives of a cost by junctions and durations, each with all others held.
struct MincoGradient {
  std::array<Junction, kMaxPieces + 1> junctions;
  std::array<double, kMaxPieces> durations;
};
/// A gradient of zeros, for this many pieces.
void set_zero(MincoGradient& gradient, int pieces);

/// ∫‖jerk‖² and its partial derivatives by positions and durations; those by inner velocities and
/// accelerations vanish at the solution.
double add_jerk_energy(const Minco& minco, MincoGradient& gradient);

/// Turns partial derivatives into total ones (inner positions and durations), by the adjoint of the
/// system in solve(). Cost: linear in pieces.
void propagate(const Minco& minco, MincoGradient& gradient);

/// Both ends of a piece in its own time scale.
ScaledEnds scaled_ends(const Minco& minco, int piece);
/// The piece as a polynomial.
QuinticPiece piece_of(const Minco& minco, int piece);

/// Second derivative of ∫‖jerk‖² by the inner positions of one axis at these durations:
/// (pieces − 1)², symmetric, positive definite. Cost: quadratic in pieces.
using WaypointMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxPieces, kMaxPieces>;
/// The second derivative of the jerk's integral by the inner junctions' positions.
void jerk_hessian(const Minco& minco, WaypointMatrix& hessian);

}  // namespace foretrack
