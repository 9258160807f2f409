// SPDX-License-Identifier: Apache-2.0
#include "core/common/trajectory.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

QuinticPiece random_piece(Random& random, double duration_s) {
  QuinticPiece piece;
  piece.duration_s = duration_s;
  for (int j = 0; j < 6; ++j)
    for (int a = 0; a < 3; ++a) piece.coefficients(j, a) = random.normal();
  return piece;
}

TEST(QuinticPiece, EachDerivativeIsTheSlopeOfTheOneBelow) {
  Random random(1);
  const double h = 1e-5;
  for (int k = 0; k < 20; ++k) {
    const QuinticPiece piece = random_piece(random, 2.0);
    const double t = random.uniform(0.1, 1.9);
    for (int order = 1; order <= 5; ++order) {
      const Vec3 slope =
          (piece.derivative(t + h, order - 1) - piece.derivative(t - h, order - 1)) / (2.0 * h);
      EXPECT_LT((piece.derivative(t, order) - slope).norm(), 1e-5 * (1.0 + slope.norm()));
    }
  }
}

TEST(QuinticPiece, PositionIsTheSumOfPowers) {
  Random random(2);
  const QuinticPiece piece = random_piece(random, 1.0);
  Vec3 sum = Vec3::Zero();
  for (int j = 0; j < 6; ++j) sum += std::pow(0.7, j) * piece.coefficients.row(j).transpose();
  EXPECT_LT((piece.position(0.7) - sum).norm(), 1e-12);
}

PlannedTrajectory three_pieces() {
  Random random(3);
  PlannedTrajectory trajectory;
  for (const double duration_s : {0.5, 1.0, 0.25})
    trajectory.pieces.push_back(random_piece(random, duration_s));
  return trajectory;
}

TEST(PlannedTrajectory, FindsThePieceOfATime) {
  const PlannedTrajectory trajectory = three_pieces();
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 1.75);
  const auto expect_at = [&](double t_s, int piece, double local_s) {
    const auto [found, local] = trajectory.piece_at(t_s);
    EXPECT_EQ(found, &trajectory.pieces[piece]) << t_s;
    EXPECT_NEAR(local, local_s, 1e-12) << t_s;
  };
  expect_at(-1.0, 0, 0.0);
  expect_at(0.2, 0, 0.2);
  expect_at(0.5, 1, 0.0);
  expect_at(1.4, 1, 0.9);
  expect_at(1.6, 2, 0.1);
  expect_at(9.0, 2, 0.25);
}

TEST(PlannedTrajectory, RestsAfterItsEnd) {
  const PlannedTrajectory trajectory = three_pieces();
  EXPECT_EQ(trajectory.position(5.0), trajectory.position(1.75));
  EXPECT_EQ(trajectory.velocity(5.0), Vec3::Zero());
  EXPECT_EQ(trajectory.acceleration(5.0), Vec3::Zero());
  EXPECT_EQ(trajectory.jerk(5.0), Vec3::Zero());
  EXPECT_NE(trajectory.velocity(1.7), Vec3::Zero());
}

TEST(AnglePlan, PassesItsNodesWithTheirRates) {
  // Nodes of a motion with constant acceleration, which the plan must reproduce everywhere.
  AnglePlan plan{0.1, {}};
  const auto angle = [](double t) { return 3.0 + 0.4 * t + 0.5 * 1.2 * t * t; };
  for (int k = 0; k <= 10; ++k) plan.nodes.push_back({angle(0.1 * k), 0.4 + 1.2 * 0.1 * k});
  for (double t = 0.0; t < 1.0; t += 0.017) {
    EXPECT_NEAR(plan.at(t).angle_rad, angle(t), 1e-12);
    EXPECT_NEAR(plan.at(t).rate_rad_s, 0.4 + 1.2 * t, 1e-12);
  }
}

TEST(AnglePlan, HoldsItsEnds) {
  const AnglePlan plan{0.1, {{1.0, 2.0}, {1.2, 2.0}}};
  EXPECT_DOUBLE_EQ(plan.at(-1.0).angle_rad, 1.0);
  EXPECT_DOUBLE_EQ(plan.at(9.0).angle_rad, 1.2);
  EXPECT_DOUBLE_EQ(plan.at(9.0).rate_rad_s, 0.0);
  EXPECT_DOUBLE_EQ(AnglePlan().at(0.5).angle_rad, 0.0);
}

TEST(Polytope, ContainsWhatSatisfiesEveryPlane) {
  const Polytope box{{{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 2}, {0, -1, 0, 0}}};
  EXPECT_TRUE(box.contains({1, 0, 50}));
  EXPECT_FALSE(box.contains({1.001, 0, 0}));
  EXPECT_FALSE(box.contains({0, -0.001, 0}));
}

TEST(PlanNames, AreOnePerValue) {
  EXPECT_EQ(to_string(PlanStatus::kHold), "hold");
  EXPECT_EQ(to_string(PlanReason::kOk), "ok");
  EXPECT_EQ(to_string(PlanReason::kTooNearTarget), "too near the target");
}

TEST(AnglePlan, OfOneNodeIsThatAngleAtAnyTime) {
  const AnglePlan plan{.dt_s = 0.1, .nodes = {{0.7, 2.0}}};
  for (const double t_s : {-1.0, -1e-9, 0.0, 5.0}) {
    EXPECT_EQ(plan.at(t_s).angle_rad, 0.7) << t_s;
    EXPECT_EQ(plan.at(t_s).rate_rad_s, 0.0) << t_s;
  }
}

}  // namespace
}  // namespace foretrack
