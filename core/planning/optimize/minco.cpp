// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/minco.hpp"

namespace foretrack {
namespace {

// With d = p1 − p0 the jerk energy of a piece is
//   720 d²/T⁵ − 720 d(v0+v1)/T⁴ − 120 d(a0−a1)/T³ + [192(v0²+v1²) + 336 v0 v1]/T³
//   + [72(v0 a0 − v1 a1) − 48(v0 a1 − v1 a0)]/T² + [9(a0²+a1²) − 6 a0 a1]/T.
using Unknowns = Eigen::Matrix<double, 2, 3>;  // rows v, a
using Axes = Eigen::RowVector3d;

struct InversePowers {
  explicit InversePowers(double duration_s)
      : p1(1.0 / duration_s), p2(p1 * p1), p3(p2 * p1), p4(p2 * p2) {}
  double p1, p2, p3, p4;
};

/// Second derivatives of the energy by (v0, a0) and (v1, a1).
Eigen::Matrix2d coupling(const InversePowers& t) {
  Eigen::Matrix2d block;
  block << 336.0 * t.p3, -48.0 * t.p2, 48.0 * t.p2, -6.0 * t.p1;
  return block;
}

Eigen::Matrix2d diagonal(const InversePowers& before, const InversePowers& after) {
  const double mixed = 72.0 * (after.p2 - before.p2);
  Eigen::Matrix2d block;
  block << 384.0 * (before.p3 + after.p3), mixed, mixed, 18.0 * (before.p1 + after.p1);
  return block;
}

Eigen::Matrix2d inverse(const Eigen::Matrix2d& m) {
  const double scale = 1.0 / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
  Eigen::Matrix2d result;
  result << scale * m(1, 1), -scale * m(0, 1), -scale * m(1, 0), scale * m(0, 0);
  return result;
}

void factorise(Minco& minco) {
  InversePowers before(minco.durations_s[0]);
  for (int j = 1; j < minco.pieces; ++j) {
    const InversePowers after(minco.durations_s[j]);
    Eigen::Matrix2d pivot = diagonal(before, after);
    if (j > 1) pivot.noalias() -= coupling(before).transpose() * minco.gains[j - 1];
    minco.pivot_inverses[j] = inverse(pivot);
    minco.gains[j].noalias() = minco.pivot_inverses[j] * coupling(after);
    before = after;
  }
}

/// Solves the factorised system for right sides at junctions 1 … pieces − 1, in place.
void substitute(const Minco& minco, std::array<Unknowns, kMaxPieces + 1>& x) {
  for (int j = 2; j < minco.pieces; ++j) x[j] -= minco.gains[j - 1].transpose() * x[j - 1];
  for (int j = minco.pieces - 1; j >= 1; --j) {
    const Unknowns y = minco.pivot_inverses[j] * x[j];
    x[j] = y;
    if (j + 1 < minco.pieces) x[j] -= minco.gains[j] * x[j + 1];
  }
}

void substitute_positions(Minco& minco) {
  const int n = minco.pieces;
  std::array<Unknowns, kMaxPieces + 1> x;
  InversePowers before(minco.durations_s[0]);
  Axes d_before = minco.junctions[1].row(0) - minco.junctions[0].row(0);
  for (int j = 1; j < n; ++j) {
    const InversePowers after(minco.durations_s[j]);
    const Axes d_after = minco.junctions[j + 1].row(0) - minco.junctions[j].row(0);
    x[j].row(0) = 720.0 * (before.p4 * d_before + after.p4 * d_after);
    x[j].row(1) = 120.0 * (after.p3 * d_after - before.p3 * d_before);
    if (j == 1) x[j] -= coupling(before).transpose() * minco.junctions[0].bottomRows<2>();
    if (j == n - 1) x[j] -= coupling(after) * minco.junctions[n].bottomRows<2>();
    before = after;
    d_before = d_after;
  }
  substitute(minco, x);
  for (int j = 1; j < n; ++j) minco.junctions[j].bottomRows<2>() = x[j];
}

/// Partial derivative of a piece's energy by d = p1 − p0.
Axes energy_by_step(const Minco& minco, int i, const InversePowers& t) {
  const Junction &s0 = minco.junctions[i], &s1 = minco.junctions[i + 1];
  return 1440.0 * t.p4 * t.p1 * (s1.row(0) - s0.row(0)) - 720.0 * t.p4 * (s0.row(1) + s1.row(1)) -
         120.0 * t.p3 * (s0.row(2) - s1.row(2));
}

}  // namespace

void set_ends(Minco& minco, const BoundaryState& start, const BoundaryState& goal, int pieces) {
  minco.pieces = pieces;
  minco.junctions[0] << start.position.transpose(), start.velocity.transpose(),
      start.acceleration.transpose();
  minco.junctions[pieces] << goal.position.transpose(), goal.velocity.transpose(),
      goal.acceleration.transpose();
}

void solve(Minco& minco) {
  factorise(minco);
  substitute_positions(minco);
}

void set_zero(MincoGradient& gradient, int pieces) {
  for (int i = 0; i <= pieces; ++i) gradient.junctions[i].setZero();
  for (int i = 0; i < pieces; ++i) gradient.durations[i] = 0.0;
}

double add_jerk_energy(const Minco& minco, MincoGradient& gradient) {
  double energy = 0.0;
  for (int i = 0; i < minco.pieces; ++i) {
    const Junction &s0 = minco.junctions[i], &s1 = minco.junctions[i + 1];
    const InversePowers t(minco.durations_s[i]);
    const Axes d = s1.row(0) - s0.row(0);
    const Axes v0 = s0.row(1), v1 = s1.row(1), a0 = s0.row(2), a1 = s1.row(2);
    const double dd = 720.0 * d.dot(d) * t.p4 * t.p1;
    const double dv = -720.0 * d.dot(v0 + v1) * t.p4;
    const double vv = (192.0 * (v0.dot(v0) + v1.dot(v1)) + 336.0 * v0.dot(v1)) * t.p3;
    const double da = -120.0 * d.dot(a0 - a1) * t.p3;
    const double va = (72.0 * (v0.dot(a0) - v1.dot(a1)) - 48.0 * (v0.dot(a1) - v1.dot(a0))) * t.p2;
    const double aa = (9.0 * (a0.dot(a0) + a1.dot(a1)) - 6.0 * a0.dot(a1)) * t.p1;
    energy += dd + dv + vv + da + va + aa;
    gradient.durations[i] -= t.p1 * (5.0 * dd + 4.0 * dv + 3.0 * (vv + da) + 2.0 * va + aa);
    const Axes by_step = energy_by_step(minco, i, t);
    gradient.junctions[i].row(0) -= by_step;
    gradient.junctions[i + 1].row(0) += by_step;
  }
  return energy;
}

void propagate(const Minco& minco, MincoGradient& gradient) {
  const int n = minco.pieces;
  std::array<Unknowns, kMaxPieces + 1> adjoint;  // λ: H λ = −∂J/∂(v, a)
  for (int j = 1; j < n; ++j) adjoint[j] = -gradient.junctions[j].bottomRows<2>();
  substitute(minco, adjoint);
  adjoint[0].setZero();
  adjoint[n].setZero();
  for (int i = 0; i < n; ++i) {
    const Junction &s0 = minco.junctions[i], &s1 = minco.junctions[i + 1];
    const InversePowers t(minco.durations_s[i]);
    const Axes d = s1.row(0) - s0.row(0);
    const Axes v0 = s0.row(1), v1 = s1.row(1), a0 = s0.row(2), a1 = s1.row(2);
    const Axes lv0 = adjoint[i].row(0), lv1 = adjoint[i + 1].row(0);
    const Axes la0 = adjoint[i].row(1), la1 = adjoint[i + 1].row(1);
    // λ · ∂E/∂(v, a), term by term as above; each falls with its own power of T.
    const Axes by_step = -720.0 * t.p4 * (lv0 + lv1) - 120.0 * t.p3 * (la0 - la1);
    const double dv = -720.0 * t.p4 * d.dot(lv0 + lv1);
    const double da = -120.0 * t.p3 * d.dot(la0 - la1);
    const double vv =
        t.p3 * ((384.0 * v0 + 336.0 * v1).dot(lv0) + (384.0 * v1 + 336.0 * v0).dot(lv1));
    const double va = t.p2 * ((72.0 * a0 - 48.0 * a1).dot(lv0) + (48.0 * a0 - 72.0 * a1).dot(lv1) +
                              (72.0 * v0 + 48.0 * v1).dot(la0) - (72.0 * v1 + 48.0 * v0).dot(la1));
    const double aa = t.p1 * ((18.0 * a0 - 6.0 * a1).dot(la0) + (18.0 * a1 - 6.0 * a0).dot(la1));
    gradient.durations[i] -= t.p1 * (4.0 * dv + 3.0 * (da + vv) + 2.0 * va + aa);
    gradient.junctions[i].row(0) -= by_step;
    gradient.junctions[i + 1].row(0) += by_step;
  }
}

ScaledEnds scaled_ends(const Minco& minco, int piece) {
  const Junction &s0 = minco.junctions[piece], &s1 = minco.junctions[piece + 1];
  const double t = minco.durations_s[piece];
  ScaledEnds ends;
  ends << s0.row(0), t * s0.row(1), (t * t) * s0.row(2), s1.row(0), t * s1.row(1),
      (t * t) * s1.row(2);
  return ends;
}

QuinticPiece piece_of(const Minco& minco, int piece) {
  const ScaledEnds ends = scaled_ends(minco, piece);
  QuinticPiece result;
  result.duration_s = minco.durations_s[piece];
  double power = 1.0;
  for (int j = 0; j < 6; ++j, power /= result.duration_s)
    for (int r = 0; r < 6; ++r)
      result.coefficients.row(j) += (power * kHermite[r][j]) * ends.row(r);
  return result;
}

void jerk_hessian(const Minco& minco, WaypointMatrix& hessian) {
  const int n = minco.pieces;
  hessian.resize(n - 1, n - 1);
  Minco unit = minco;
  MincoGradient gradient;
  // The gradient is linear in the positions: its values at unit vectors are the columns, and the
  // three axes carry three columns at a time.
  for (int first = 0; first < n - 1; first += 3) {
    const int count = std::min(3, n - 1 - first);
    for (int i = 0; i <= n; ++i) unit.junctions[i].setZero();
    for (int c = 0; c < count; ++c) unit.junctions[first + c + 1](0, c) = 1.0;
    substitute_positions(unit);
    set_zero(gradient, n);
    for (int i = 0; i < n; ++i) {
      const Axes by_step = energy_by_step(unit, i, InversePowers(unit.durations_s[i]));
      gradient.junctions[i].row(0) -= by_step;
      gradient.junctions[i + 1].row(0) += by_step;
    }
    for (int c = 0; c < count; ++c)
      for (int r = 0; r < n - 1; ++r) hessian(r, first + c) = gradient.junctions[r + 1](0, c);
  }
}

}  // namespace foretrack
