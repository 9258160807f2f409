#include "core/planning/penalties.hpp"

#include <algorithm>

namespace foretrack {
namespace {

/// Keeps the horizontal distance differentiable at the target itself.
constexpr double kDistanceFloor_m2 = 1.0e-4;

constexpr int kNodes = kQuadratureIntervals + 1;
using Nodes = Eigen::Array<double, kNodes, 1>;  // one number per quadrature node

/// The basis polynomials' order-th derivative at all nodes: column r belongs to the r-th end value.
using BasisTable = Eigen::Array<double, kNodes, 6>;

BasisTable make_table(int order) {
  BasisTable table;
  for (int n = 0; n < kNodes; ++n) {
    const HermiteRow row = hermite(static_cast<double>(n) / kQuadratureIntervals, order);
    for (int r = 0; r < 6; ++r) table(n, r) = row[r];
  }
  return table;
}
const std::array<BasisTable, 3> kBasis = {make_table(0), make_table(1), make_table(2)};

Nodes make_trapezoid() {
  Nodes weights = Nodes::Ones();
  weights[0] = weights[kNodes - 1] = 0.5;
  return weights;
}
const Nodes kTrapezoid = make_trapezoid();  // ω̄_j

/// A vector at each node.
struct NodeVectors {
  Nodes x, y, z;
  void set_zero() {
    x.setZero();
    y.setZero();
    z.setZero();
  }
  Nodes squared_norm() const { return x * x + y * y + z * z; }
  Nodes dot(const NodeVectors& o) const { return x * o.x + y * o.y + z * o.z; }
  void add_scaled(const Nodes& factor, const NodeVectors& o) {
    x += factor * o.x;
    y += factor * o.y;
    z += factor * o.z;
  }
};

NodeVectors evaluate(const ScaledEnds& ends, int order, double scale) {
  NodeVectors v;
  v.set_zero();
  const BasisTable& basis = kBasis[order];
  for (int r = 0; r < 6; ++r) {
    v.x += (scale * ends(r, 0)) * basis.col(r);
    v.y += (scale * ends(r, 1)) * basis.col(r);
    v.z += (scale * ends(r, 2)) * basis.col(r);
  }
  return v;
}

void add_transposed(const NodeVectors& v, int order, double scale, ScaledEnds& ends) {
  const BasisTable& basis = kBasis[order];
  for (int r = 0; r < 6; ++r) {
    ends(r, 0) += scale * (basis.col(r) * v.x).sum();
    ends(r, 1) += scale * (basis.col(r) * v.y).sum();
    ends(r, 2) += scale * (basis.col(r) * v.z).sum();
  }
}

/// Adds the gradient by scaled end values to the junctions, and returns its share of ∂J/∂T.
double add_scaled_gradient(const Minco& minco, int piece, const ScaledEnds& by_ends,
                           MincoGradient& gradient) {
  const Junction &s0 = minco.junctions[piece], &s1 = minco.junctions[piece + 1];
  Junction &g0 = gradient.junctions[piece], &g1 = gradient.junctions[piece + 1];
  const double t = minco.durations_s[piece];
  g0.row(0) += by_ends.row(0);
  g0.row(1) += t * by_ends.row(1);
  g0.row(2) += (t * t) * by_ends.row(2);
  g1.row(0) += by_ends.row(3);
  g1.row(1) += t * by_ends.row(4);
  g1.row(2) += (t * t) * by_ends.row(5);
  return by_ends.row(1).dot(s0.row(1)) + by_ends.row(4).dot(s1.row(1)) +
         2.0 * t * (by_ends.row(2).dot(s0.row(2)) + by_ends.row(5).dot(s1.row(2)));
}

/// Corridor penalty Σ ω̄ max(a·p − b + margin, 0)³ over nodes and planes. Planes that the nodes'
/// bounding box does not reach are passed over.
double corridor_cost(const NodeVectors& p, const Polytope& polytope, double margin_m,
                     NodeVectors& by_position) {
  const Vec3 low(p.x.minCoeff(), p.y.minCoeff(), p.z.minCoeff());
  const Vec3 high(p.x.maxCoeff(), p.y.maxCoeff(), p.z.maxCoeff());
  const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double cost = 0.0;
  for (const Eigen::Vector4d& plane : polytope.planes) {
    const Vec3 a = plane.head<3>();
    const double offset = plane[3] - margin_m;
    if (a.dot(middle) + a.cwiseAbs().dot(half) <= offset) continue;
    const Nodes g = (a.x() * p.x + a.y() * p.y + a.z() * p.z - offset).max(0.0);
    const Nodes weighted = kTrapezoid * g * g;
    cost += (weighted * g).sum();
    by_position.x += (3.0 * a.x()) * weighted;
    by_position.y += (3.0 * a.y()) * weighted;
    by_position.z += (3.0 * a.z()) * weighted;
  }
  return cost;
}

/// Σ ω̄ max(‖u‖² − limit², 0)³ over nodes.
double norm_cost(const NodeVectors& u, double limit, double weight, NodeVectors& by_vector) {
  const Nodes g = (u.squared_norm() - limit * limit).max(0.0);
  if (g.maxCoeff() <= 0.0) return 0.0;
  const Nodes weighted = weight * kTrapezoid * g * g;
  by_vector.add_scaled(6.0 * weighted, u);
  return (weighted * g).sum();
}

}  // namespace

Sector make_sector(const Vec3& apex_enu_m, double bisector_rad, double half_angle_rad) {
  return {apex_enu_m, direction_of(bisector_rad), std::cos(half_angle_rad)};
}

void add_visibility(const Vec3& p, const Sector& sector, double weight, PointPenalty& sum) {
  const Vec2 d = (p - sector.apex).head<2>();
  const double norm = std::sqrt(d.squaredNorm() + kDistanceFloor_m2);
  const double cosine = d.dot(sector.bisector) / norm;
  const Hinge hinge = cubed_hinge(sector.cos_half_angle - cosine);
  if (hinge.slope == 0.0) return;
  sum.value += weight * hinge.value;
  sum.gradient.head<2>() -= (weight * hinge.slope / norm) * (sector.bisector - (cosine / norm) * d);
}

void add_distance_band(const Vec3& p, const Vec3& target, double low_m, double high_m,
                       double weight, PointPenalty& sum) {
  const Vec2 d = (p - target).head<2>();
  const double norm = std::sqrt(d.squaredNorm() + kDistanceFloor_m2);
  const Hinge near = cubed_hinge(low_m - norm), far = cubed_hinge(norm - high_m);
  sum.value += weight * (near.value + far.value);
  sum.gradient.head<2>() += (weight * (far.slope - near.slope) / norm) * d;
}

void add_height_band(const Vec3& p, double height_m, double band_m, double weight,
                     PointPenalty& sum) {
  const double above = p.z() - height_m;
  const Hinge hinge = cubed_hinge(std::abs(above) - band_m);
  sum.value += weight * hinge.value;
  sum.gradient.z() += weight * std::copysign(hinge.slope, above);
}

double add_piece_penalties(const Minco& minco, int piece, const Polytope& polytope,
                           const PieceWeights& weights, MincoGradient& gradient) {
  const double t = minco.durations_s[piece], rate = 1.0 / t;
  const ScaledEnds ends = scaled_ends(minco, piece);
  const NodeVectors p = evaluate(ends, 0, 1.0), v = evaluate(ends, 1, rate),
                    a = evaluate(ends, 2, rate * rate);
  NodeVectors by_p, by_v, by_a;
  by_p.set_zero();
  by_v.set_zero();
  by_a.set_zero();
  const double corridor = corridor_cost(p, polytope, weights.corridor_margin_m, by_p);
  const double speed = norm_cost(v, weights.speed_limit_m_s, weights.speed, by_v);
  const double acceleration =
      norm_cost(a, weights.acceleration_limit_m_s2, weights.acceleration, by_a);
  const double sum = weights.corridor * corridor + speed + acceleration;
  if (sum == 0.0) return 0.0;

  const double step = t / kQuadratureIntervals;
  ScaledEnds by_ends = ScaledEnds::Zero();
  if (corridor > 0.0) add_transposed(by_p, 0, step * weights.corridor, by_ends);
  if (speed > 0.0) add_transposed(by_v, 1, step * rate, by_ends);
  if (acceleration > 0.0) add_transposed(by_a, 2, step * rate * rate, by_ends);
  // T acts through the step, through 1/T in v and 1/T² in a, and through the scaled ends.
  const double through_rates = -step * rate * (by_v.dot(v).sum() + 2.0 * by_a.dot(a).sum());
  gradient.durations[piece] += sum / kQuadratureIntervals + through_rates +
                               add_scaled_gradient(minco, piece, by_ends, gradient);
  return step * sum;
}

void advance(const Minco& minco, double time_s, PieceTime& at) {
  while (at.piece + 1 < minco.pieces && time_s > at.start_s + minco.durations_s[at.piece])
    at.start_s += minco.durations_s[at.piece++];
  at.alpha = std::clamp((time_s - at.start_s) / minco.durations_s[at.piece], 0.0, 1.0);
}

Vec3 position_at(const Minco& minco, const PieceTime& at) {
  const HermiteRow h = hermite(at.alpha, 0);
  return scaled_ends(minco, at.piece).transpose() *
         Eigen::Map<const Eigen::Matrix<double, 6, 1>>(h.data());
}

double add_position_gradient(const Minco& minco, const PieceTime& at, const Vec3& by_position,
                             MincoGradient& gradient) {
  const HermiteRow h = hermite(at.alpha, 0), slope = hermite(at.alpha, 1);
  const ScaledEnds ends = scaled_ends(minco, at.piece);
  ScaledEnds by_ends;
  Vec3 velocity = Vec3::Zero();
  for (int r = 0; r < 6; ++r) {
    by_ends.row(r) = h[r] * by_position.transpose();
    velocity += slope[r] * ends.row(r).transpose();
  }
  const double shift = -by_position.dot(velocity) / minco.durations_s[at.piece];
  gradient.durations[at.piece] +=
      at.alpha * shift + add_scaled_gradient(minco, at.piece, by_ends, gradient);
  return shift;
}

}  // namespace foretrack
