// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/penalties.hpp"

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

/// Bézier control points of a piece's derivatives: the curve lies in their hull, so that most
/// pieces are seen to be free of penalties without looking at their nodes.
template <std::size_t N>
using Hull = std::array<Vec3, N>;

Hull<6> position_hull(const ScaledEnds& q) {
  const auto row = [&](int r) -> Vec3 { return q.row(r); };
  return {row(0),
          row(0) + 0.2 * row(1),
          row(0) + 0.4 * row(1) + 0.05 * row(2),
          row(3) - 0.4 * row(4) + 0.05 * row(5),
          row(3) - 0.2 * row(4),
          row(3)};
}

/// The control points of the derivative, times 1/T.
template <std::size_t N>
Hull<N - 1> derivative_hull(const Hull<N>& hull, double rate) {
  Hull<N - 1> result;
  for (std::size_t i = 0; i + 1 < N; ++i) result[i] = ((N - 1) * rate) * (hull[i + 1] - hull[i]);
  return result;
}

template <std::size_t N>
bool exceeds(const Hull<N>& hull, double limit) {
  double most = 0.0;
  for (const Vec3& point : hull) most = std::max(most, point.squaredNorm());
  return most > limit * limit;
}

/// An axis-parallel box, for the quick test of planes.
struct Box {
  explicit Box(const Hull<6>& hull) {
    Vec3 low = hull[0], high = hull[0];
    for (const Vec3& point : hull) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    middle = 0.5 * (low + high);
    half = 0.5 * (high - low);
  }
  bool reaches(const Eigen::Vector4d& plane, double margin_m) const {
    const double middle_m = plane[0] * middle.x() + plane[1] * middle.y() + plane[2] * middle.z();
    const double half_m = std::abs(plane[0]) * half.x() + std::abs(plane[1]) * half.y() +
                          std::abs(plane[2]) * half.z();
    return middle_m + half_m > plane[3] - margin_m;
  }
  Vec3 middle, half;
};

/// A penalty over a piece's nodes: cost Σ ω̄ max(G, 0)³, and its gradient by the scaled ends and by
/// the duration as far as that acts through 1/T in the derivative's definition.
struct NodePenalty {
  double cost = 0.0;
  ScaledEnds by_ends = ScaledEnds::Zero();
  double by_rate = 0.0;  // ∂cost/∂T · T through 1/T^order
};

/// Planes that the box does not reach cost nothing and are passed over.
void add_corridor(const ScaledEnds& ends, const Hull<6>& hull, const Polytope& polytope,
                  double margin_m, double weight, NodePenalty& sum) {
  const Box box(hull);
  NodeVectors p, by_p;
  double cost = 0.0;
  bool evaluated = false;
  for (const Eigen::Vector4d& plane : polytope.planes) {
    if (!box.reaches(plane, margin_m)) continue;
    if (!evaluated) {
      p = evaluate(ends, 0, 1.0);
      by_p.set_zero();
      evaluated = true;
    }
    const Nodes g =
        (plane[0] * p.x + plane[1] * p.y + plane[2] * p.z - (plane[3] - margin_m)).max(0.0);
    const Nodes weighted = kTrapezoid * g * g;
    cost += (weighted * g).sum();
    by_p.x += (3.0 * plane[0]) * weighted;
    by_p.y += (3.0 * plane[1]) * weighted;
    by_p.z += (3.0 * plane[2]) * weighted;
  }
  if (cost == 0.0) return;
  sum.cost += weight * cost;
  add_transposed(by_p, 0, weight, sum.by_ends);
}

/// G = ‖order-th derivative‖² − limit².
void add_norm_limit(const ScaledEnds& ends, int order, double scale, double limit, double weight,
                    NodePenalty& sum) {
  const NodeVectors u = evaluate(ends, order, scale);
  const Nodes norm2 = u.squared_norm();
  const Nodes g = (norm2 - limit * limit).max(0.0);
  const Nodes weighted = weight * kTrapezoid * g * g;
  const double cost = (weighted * g).sum();
  if (cost == 0.0) return;
  sum.cost += cost;
  const Nodes slope = 6.0 * weighted;  // times u: the gradient by u
  add_transposed({slope * u.x, slope * u.y, slope * u.z}, order, scale, sum.by_ends);
  sum.by_rate -= order * (slope * norm2).sum();
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
  const Hinge near = cubed_hinge(low_m - norm), far = reaching_hinge(norm - high_m, kFarReach_m);
  sum.value += weight * (near.value + far.value);
  sum.gradient.head<2>() += (weight * (far.slope - near.slope) / norm) * d;
}

void add_height_band(const Vec3& p, double height_m, double band_m, double weight,
                     PointPenalty& sum) {
  const double above = p.z() - height_m;
  const Hinge hinge = reaching_hinge(std::abs(above) - band_m, kFarReach_m);
  sum.value += weight * hinge.value;
  sum.gradient.z() += weight * std::copysign(hinge.slope, above);
}

void add_gap(const Vec3& p, double ball_radius_m, const Pillar& pillar, double wanted_m,
             double weight, PointPenalty& sum) {
  const Vec3 d = p - pillar.foot;
  const double touched_m = wanted_m + ball_radius_m + pillar.radius_m;
  if (d.head<2>().squaredNorm() > touched_m * touched_m) return;
  const double from_axis_m = std::sqrt(d.head<2>().squaredNorm() + kDistanceFloor_m2);
  const double beside_m = from_axis_m - pillar.radius_m;
  const double middle_m = d.z() - 0.5 * pillar.height_m;
  const double above_m = std::abs(middle_m) - 0.5 * pillar.height_m;
  const double distance_m =
      beside_m > 0.0 && above_m > 0.0 ? std::hypot(beside_m, above_m) : std::max(beside_m, above_m);
  const Hinge hinge = cubed_hinge(wanted_m + ball_radius_m - distance_m);
  if (hinge.slope == 0.0) return;
  // ∂ distance / ∂ (beside, above): beyond an edge both count, else the greater
  // one alone.
  const bool edge = beside_m > 0.0 && above_m > 0.0;
  const double by_beside = edge ? beside_m / distance_m : beside_m >= above_m ? 1.0 : 0.0;
  const double by_above = edge ? above_m / distance_m : beside_m >= above_m ? 0.0 : 1.0;
  sum.value += weight * hinge.value;
  sum.gradient.head<2>() -= (weight * hinge.slope * by_beside / from_axis_m) * d.head<2>();
  sum.gradient.z() -= weight * hinge.slope * by_above * std::copysign(1.0, middle_m);
}

double add_piece_penalties(const Minco& minco, int piece, const Polytope& polytope,
                           const PieceWeights& weights, MincoGradient& gradient) {
  const double t = minco.durations_s[piece], rate = 1.0 / t;
  const ScaledEnds ends = scaled_ends(minco, piece);
  const Hull<6> positions = position_hull(ends);
  const Hull<5> velocities = derivative_hull(positions, rate);
  const Hull<4> accelerations = derivative_hull(velocities, rate);
  NodePenalty sum;
  add_corridor(ends, positions, polytope, weights.corridor_margin_m, weights.corridor, sum);
  if (exceeds(velocities, weights.speed_limit_m_s))
    add_norm_limit(ends, 1, rate, weights.speed_limit_m_s, weights.speed, sum);
  if (exceeds(accelerations, weights.acceleration_limit_m_s2))
    add_norm_limit(ends, 2, rate * rate, weights.acceleration_limit_m_s2, weights.acceleration,
                   sum);
  if (sum.cost == 0.0) return 0.0;
  // T acts through the step T/κ, through 1/T in the derivatives, and through the scaled ends.
  const double step = t / kQuadratureIntervals;
  sum.by_ends *= step;
  gradient.durations[piece] += (sum.cost + sum.by_rate) / kQuadratureIntervals +
                               add_scaled_gradient(minco, piece, sum.by_ends, gradient);
  return step * sum.cost;
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
