// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/minco.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

BoundaryState random_state(Random& random) {
  const auto vector = [&](double size) {
    return Vec3(random.uniform(-size, size), random.uniform(-size, size),
                random.uniform(-size, size));
  };
  return {vector(5.0), vector(2.0), vector(3.0)};
}

Minco random_minco(std::uint64_t seed, int pieces) {
  Random random(seed);
  Minco minco;
  set_ends(minco, random_state(random), random_state(random), pieces);
  for (int i = 1; i < pieces; ++i)
    minco.junctions[i].row(0) = random_state(random).position.transpose();
  for (int i = 0; i < pieces; ++i) minco.durations_s[i] = random.uniform(0.2, 1.5);
  solve(minco);
  return minco;
}

double energy_by_sums(const Minco& minco) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < minco.pieces; ++i) {
    const QuinticPiece piece = piece_of(minco, i);
    for (int s = 0; s < kSteps; ++s)
      sum += piece.jerk((s + 0.5) * piece.duration_s / kSteps).squaredNorm() * piece.duration_s /
             kSteps;
  }
  return sum;
}

double energy_of(Minco minco) {
  solve(minco);
  MincoGradient unused;
  set_zero(unused, minco.pieces);
  return add_jerk_energy(minco, unused);
}

TEST(Minco, PassesThroughItsEndsAndWaypoints) {
  const Minco minco = random_minco(1, 7);
  for (int i = 0; i < minco.pieces; ++i) {
    const QuinticPiece piece = piece_of(minco, i);
    for (int order = 0; order < 3; ++order) {
      EXPECT_LT((piece.derivative(0.0, order).transpose() - minco.junctions[i].row(order)).norm(),
                1e-9);
      EXPECT_LT((piece.derivative(piece.duration_s, order).transpose() -
                 minco.junctions[i + 1].row(order))
                    .norm(),
                1e-8);
    }
  }
}

// MINCO's condition of optimality: derivatives up to the fourth (2s − 2) are continuous.
TEST(Minco, JerkAndSnapAreContinuousAtJunctions) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Minco minco = random_minco(seed, 2 + static_cast<int>(seed));
    for (int i = 0; i + 1 < minco.pieces; ++i) {
      const QuinticPiece before = piece_of(minco, i), after = piece_of(minco, i + 1);
      for (int order = 3; order <= 4; ++order) {
        const Vec3 end = before.derivative(before.duration_s, order);
        EXPECT_LT((end - after.derivative(0.0, order)).norm(), 1e-7 * (1.0 + end.norm()));
      }
    }
  }
}

// The same trajectory as from the coefficients' full 6M × 6M system.
TEST(Minco, AgreesWithTheCoefficientSystem) {
  const Minco minco = random_minco(5, 4);
  const int n = minco.pieces;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6 * n, 6 * n),
                  right = Eigen::MatrixXd::Zero(6 * n, 3);
  const auto beta = [](double t, int order) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6);
    for (int j = order; j < 6; ++j) {
      row[j] = std::pow(t, j - order);
      for (int m = 0; m < order; ++m) row[j] *= j - m;
    }
    return row;
  };
  int r = 0;
  for (int order = 0; order < 3; ++order, r += 2) {
    system.block(r, 0, 1, 6) = beta(0.0, order);
    right.row(r) = minco.junctions[0].row(order);
    system.block(r + 1, 6 * (n - 1), 1, 6) = beta(minco.durations_s[n - 1], order);
    right.row(r + 1) = minco.junctions[n].row(order);
  }
  for (int i = 0; i + 1 < n; ++i) {
    system.block(r, 6 * i, 1, 6) = beta(minco.durations_s[i], 0);
    right.row(r++) = minco.junctions[i + 1].row(0);
    for (int order = 0; order < 5; ++order) {
      system.block(r, 6 * i, 1, 6) = beta(minco.durations_s[i], order);
      system.block(r++, 6 * (i + 1), 1, 6) = -beta(0.0, order);
    }
  }
  const Eigen::MatrixXd coefficients = system.fullPivLu().solve(right);
  for (int i = 0; i < n; ++i)
    EXPECT_LT(
        (coefficients.middleRows(6 * i, 6) - piece_of(minco, i).coefficients).cwiseAbs().maxCoeff(),
        1e-6);
}

TEST(Minco, EnergyIsTheIntegralOfSquaredJerk) {
  const Minco minco = random_minco(2, 5);
  EXPECT_NEAR(energy_of(minco) / energy_by_sums(minco), 1.0, 1e-5);
}

// A cost of everything: Σ of a random linear function of all junction states, plus the energy.
struct AnyCost {
  MincoGradient slopes;
  explicit AnyCost(int pieces) {
    Random random(77);
    set_zero(slopes, pieces);
    for (int i = 0; i <= pieces; ++i)
      for (int e = 0; e < 9; ++e) slopes.junctions[i](e / 3, e % 3) = random.uniform(-50.0, 50.0);
  }
  double value(Minco minco) const {
    double sum = energy_of(minco);
    solve(minco);
    for (int i = 0; i <= minco.pieces; ++i)
      sum += slopes.junctions[i].cwiseProduct(minco.junctions[i]).sum();
    return sum;
  }
};

TEST(Minco, AdjointGradientAgreesWithFiniteDifferences) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Minco minco = random_minco(seed, 2 + static_cast<int>(seed));
    const AnyCost cost(minco.pieces);
    MincoGradient gradient = cost.slopes;
    add_jerk_energy(minco, gradient);
    propagate(minco, gradient);
    const auto difference = [&](double& value, const Minco& changed) {
      const double middle = value, step = 1e-5;
      value = middle + step;
      const double above = cost.value(changed);
      value = middle - step;
      const double below = cost.value(changed);
      value = middle;
      return (above - below) / (2.0 * step);
    };
    Minco changed = minco;
    for (int i = 1; i < minco.pieces; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double expected = difference(changed.junctions[i](0, axis), changed);
        EXPECT_NEAR(gradient.junctions[i](0, axis), expected, 1e-5 * (1e3 + std::abs(expected)));
      }
    for (int i = 0; i < minco.pieces; ++i) {
      const double expected = difference(changed.durations_s[i], changed);
      EXPECT_NEAR(gradient.durations[i], expected, 1e-5 * (1e3 + std::abs(expected)));
    }
  }
}

TEST(Minco, HessianPredictsTheEnergyOfAnyStep) {
  Minco minco = random_minco(3, 9);
  WaypointMatrix hessian;
  jerk_hessian(minco, hessian);
  set_ends(minco, {}, {}, 9);
  Random random(4);
  Eigen::VectorXd step(8);
  for (int i = 0; i < 8; ++i) {
    step[i] = random.normal();
    minco.junctions[i + 1].row(0) = Vec3(0.0, step[i], 0.0).transpose();
  }
  EXPECT_NEAR(0.5 * step.dot(hessian * step) / energy_of(minco), 1.0, 1e-9);
  EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-8 * hessian.norm());
}

}  // namespace
}  // namespace foretrack
