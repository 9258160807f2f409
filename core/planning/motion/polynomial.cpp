// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr int kRefinements = 60;

/// The root between a and b, where the values have different signs: Newton's steps while they stay
/// inside the bracket, else halving.
double root_between(const Polynomial& p, const Polynomial& slope, double a, double b) {
  const bool rising = p.at(a) < 0.0;
  double x = 0.5 * (a + b);
  for (int i = 0; i < kRefinements; ++i) {
    const double value = p.at(x);
    if (value == 0.0) break;
    ((value < 0.0) == rising ? a : b) = x;
    const double newton = x - value / slope.at(x);
    const double next = newton > a && newton < b ? newton : 0.5 * (a + b);
    if (std::abs(next - x) < 1e-15) return next;
    x = next;
  }
  return x;
}

/// ‖order-th derivative‖² over normalised time.
Polynomial squared_norm(const QuinticPiece& piece, int order) {
  const int degree = 5 - order;
  Eigen::Matrix<double, 6, 3> c;
  double power = 1.0;
  for (int j = 0; j <= degree; ++j, power *= piece.duration_s) {
    double factor = power;
    for (int m = 0; m < order; ++m) factor *= j + order - m;
    c.row(j) = factor * piece.coefficients.row(j + order);
  }
  Polynomial square;
  square.degree = 2 * degree;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j) square.c[i + j] += c.row(i).dot(c.row(j));
  return square;
}

constexpr std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1> make_binomials() {
  std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1> table{};
  for (int n = 0; n <= kMaxDegree; ++n) {
    table[n][0] = 1.0;
    for (int k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0);
  }
  return table;
}
constexpr auto kBinomials = make_binomials();

}  // namespace

Polynomial Polynomial::derivative() const {
  Polynomial result;
  result.degree = std::max(degree - 1, 0);
  for (int j = 1; j <= degree; ++j) result.c[j - 1] = j * c[j];
  return result;
}

Roots sign_changes(const Polynomial& p) {
  // From the derivative of degree 1 upwards: each one's roots bracket those of the next.
  std::array<Polynomial, kMaxDegree + 1> derivatives;
  derivatives[0] = p;
  for (int i = 1; i < p.degree; ++i) derivatives[i] = derivatives[i - 1].derivative();
  Roots critical;
  for (int i = p.degree - 1; i >= 0; --i) {
    const Polynomial& f = derivatives[i];
    const Polynomial slope = f.derivative();
    Roots roots;
    double a = 0.0, value_a = f.at(0.0);
    for (int k = 0; k <= critical.count; ++k) {
      const double b = k < critical.count ? critical.at[k] : 1.0, value_b = f.at(b);
      if ((value_a < 0.0) != (value_b < 0.0) && roots.count < f.degree)
        roots.at[roots.count++] = root_between(f, slope, a, b);
      a = b, value_a = value_b;
    }
    critical = roots;
  }
  return critical;
}

double upper_bound(const Polynomial& p) {
  double most = p.c[0];
  for (int i = 1; i <= p.degree; ++i) {
    double b = 0.0;
    for (int j = 0; j <= i; ++j) b += kBinomials[i][j] / kBinomials[p.degree][j] * p.c[j];
    most = std::max(most, b);
  }
  return most;
}

Peak peak_norm(std::span<const QuinticPiece> pieces, int order) {
  double most = -1.0, most_at_s = 0.0, start_s = 0.0;
  const auto offer = [&](double square, double at_s) {
    if (square > most) most = square, most_at_s = at_s;
  };
  for (const QuinticPiece& piece : pieces) {
    offer(piece.derivative(0.0, order).squaredNorm(), start_s);
    start_s += piece.duration_s;
    offer(piece.derivative(piece.duration_s, order).squaredNorm(), start_s);
  }
  start_s = 0.0;
  for (const QuinticPiece& piece : pieces) {
    const Polynomial square = squared_norm(piece, order);
    if (upper_bound(square) > most) {
      const Roots roots = sign_changes(square.derivative());
      for (int i = 0; i < roots.count; ++i)
        offer(square.at(roots.at[i]), start_s + roots.at[i] * piece.duration_s);
    }
    start_s += piece.duration_s;
  }
  return {std::sqrt(std::max(most, 0.0)), most_at_s};
}

}  // namespace foretrack
