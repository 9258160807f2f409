// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/polynomial.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

Polynomial with_roots(std::initializer_list<double> roots) {
  Polynomial p;
  p.c[0] = 1.0;
  for (const double root : roots) {
    for (int j = ++p.degree; j > 0; --j) p.c[j] = p.c[j - 1] - root * p.c[j];
    p.c[0] *= -root;
  }
  return p;
}

QuinticPiece random_piece(Random& random) {
  QuinticPiece piece;
  piece.duration_s = random.uniform(0.1, 3.0);
  for (int j = 0; j < 6; ++j)
    for (int axis = 0; axis < 3; ++axis)
      piece.coefficients(j, axis) = random.normal() / std::pow(piece.duration_s, j);
  return piece;
}

TEST(Polynomial, FindsAllRootsInTheInterval) {
  const Polynomial p = with_roots({0.9, 0.1, -0.5, 0.35, 1.7, 0.3500001, 0.5});
  const Roots roots = sign_changes(p);
  ASSERT_EQ(roots.count, 5);
  const std::array<double, 5> expected{0.1, 0.35, 0.3500001, 0.5, 0.9};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(roots.at[i], expected[i], 1e-7);
}

TEST(Polynomial, ConstantAndRootlessPolynomialsHaveNoSignChange) {
  EXPECT_EQ(sign_changes(Polynomial{}).count, 0);
  EXPECT_EQ(sign_changes({2, {1.0, 0.0, 1.0}}).count, 0);
  EXPECT_EQ(sign_changes({1, {-2.0, 1.0}}).count, 0);
}

TEST(Polynomial, UpperBoundIsNeverBelowAValue) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Polynomial p;
    p.degree = random.integer(0, kMaxDegree);
    for (int j = 0; j <= p.degree; ++j) p.c[j] = random.normal();
    const double bound = upper_bound(p);
    for (int k = 0; k <= 50; ++k) EXPECT_LE(p.at(k / 50.0), bound + 1e-12);
  }
}

TEST(Polynomial, PeakNormAgreesWithDenseSampling) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    std::vector<QuinticPiece> pieces;
    for (int k = random.integer(1, 6); k > 0; --k) pieces.push_back(random_piece(random));
    for (int order = 1; order <= 3; ++order) {
      double densest = 0.0;
      for (const QuinticPiece& piece : pieces)
        for (int k = 0; k <= 1000; ++k)
          densest =
              std::max(densest, piece.derivative(piece.duration_s * k / 1000.0, order).norm());
      const Peak peak = peak_norm(pieces, order);
      EXPECT_GE(peak.value, densest * (1.0 - 1e-12));
      EXPECT_LE(peak.value, densest * (1.0 + 1e-4));
      PlannedTrajectory trajectory;
      trajectory.pieces = pieces;
      const auto [piece, local_s] = trajectory.piece_at(peak.time_s - 1e-12);
      EXPECT_NEAR(piece->derivative(local_s, order).norm(), peak.value, 1e-6 * peak.value);
    }
  }
}

}  // namespace
}  // namespace foretrack
