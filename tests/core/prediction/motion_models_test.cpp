// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_models.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

const PlanarState kWalker{{1.0, -2.0}, {1.2, 0.5}};

// Many small Euler steps of v' = rate × v.
PlanarState integrate_turn(PlanarState x, double rate, double dt_s) {
  constexpr int kSteps = 200000;
  const double h = dt_s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Vec2 middle =
        x.velocity_m_s + 0.5 * h * rate * Vec2(-x.velocity_m_s.y(), x.velocity_m_s.x());
    x.position_m += h * middle;
    x.velocity_m_s += h * rate * Vec2(-middle.y(), middle.x());
  }
  return x;
}

TEST(MotionModels, TurnFollowsTheIntegralOfItsEquation) {
  for (const double rate : {-2.5, -0.3, 0.7, 3.0}) {
    const PlanarState exact = integrate_turn(kWalker, rate, 0.8);
    const PlanarState x = advance(MotionModel::turn(rate), kWalker, 0.8);
    EXPECT_NEAR((x.position_m - exact.position_m).norm(), 0.0, 1e-6) << rate;
    EXPECT_NEAR((x.velocity_m_s - exact.velocity_m_s).norm(), 0.0, 1e-6) << rate;
  }
}

TEST(MotionModels, TurnBecomesConstantVelocityAsTheRateVanishes) {
  const PlanarState straight = advance(MotionModel::constant_velocity(), kWalker, 2.0);
  for (const double rate : {0.0, 1e-300, 1e-12, -1e-9}) {
    const PlanarState x = advance(MotionModel::turn(rate), kWalker, 2.0);
    EXPECT_NEAR((x.position_m - straight.position_m).norm(), 0.0, 1e-8) << rate;
  }
  // No jump where the series takes over.
  const PlanarState below = advance(MotionModel::turn(0.99e-4), kWalker, 1.0);
  const PlanarState above = advance(MotionModel::turn(1.01e-4), kWalker, 1.0);
  EXPECT_NEAR((above.position_m - below.position_m).norm(), 1e-6 * kWalker.velocity_m_s.norm(),
              1e-8);
}

TEST(MotionModels, TurnToTheLeftIsPositive) {
  EXPECT_GT(advance(MotionModel::turn(1.0), {{0, 0}, {1, 0}}, 0.5).position_m.y(), 0.0);
  EXPECT_LT(advance(MotionModel::turn(-1.0), {{0, 0}, {1, 0}}, 0.5).position_m.y(), 0.0);
}

TEST(MotionModels, DecelerationEndsAtRestAndNeverGoesBackwards) {
  const auto model = MotionModel::deceleration(1.0);
  const double speed = kWalker.velocity_m_s.norm();
  double before_m = 0.0;
  for (double t = 0.0; t < 5.0; t += 0.1) {
    const PlanarState x = advance(model, kWalker, t);
    const double along_m = (x.position_m - kWalker.position_m).dot(kWalker.velocity_m_s) / speed;
    EXPECT_GE(along_m, before_m - 1e-12);
    EXPECT_GE(x.velocity_m_s.dot(kWalker.velocity_m_s), 0.0);
    before_m = along_m;
  }
  EXPECT_NEAR(before_m, speed * speed / 2.0, 1e-9);  // v² / 2a
  EXPECT_EQ(advance(model, kWalker, 5.0).velocity_m_s, Vec2::Zero());
  EXPECT_EQ(advance(model, {{1, 2}, {0, 0}}, 1.0).position_m, Vec2(1, 2));
}

TEST(MotionModels, AReversalSlowsDownTurnsRoundAndIsThenWalkedBack) {
  const PlanarState east{{0, 0}, {1.5, 0}};
  const auto model = MotionModel::reversal(3.0, {-1.5, 0});
  EXPECT_NEAR(advance(model, east, 0.5).velocity_m_s.norm(), 0.0, 1e-12);
  EXPECT_NEAR(advance(model, east, 0.5).position_m.x(), 1.5 * 1.5 / 6.0, 1e-12);  // v² / 2a
  EXPECT_NEAR(advance(model, east, 1.0).position_m.x(), 0.0, 1e-12) << "back where it began";
  EXPECT_NEAR(advance(model, east, 3.0).position_m.x(), -3.0, 1e-12);
  EXPECT_EQ(advance(model, east, 3.0).velocity_m_s, Vec2(-1.5, 0));
}

TEST(MotionModels, AReversalIsNeverFasterThanAtItsStartOrItsGoal) {
  const auto model = MotionModel::reversal(2.5, {-0.8, 0.7});
  const double most = std::max(kWalker.velocity_m_s.norm(), model.goal_m_s.norm());
  for (double t = 0.0; t < 3.0; t += 0.05)
    EXPECT_LE(advance(model, kWalker, t).velocity_m_s.norm(), most + 1e-12);
}

TEST(MotionModels, TwoStepsAreOneLongStep) {
  for (const auto& model :
       {MotionModel::constant_velocity(), MotionModel::turn(1.3), MotionModel::deceleration(0.8),
        MotionModel::reversal(1.9, {-1.0, 0.4})}) {
    const PlanarState once = advance(model, kWalker, 1.7);
    const PlanarState twice = advance(model, advance(model, kWalker, 0.9), 0.8);
    EXPECT_NEAR((once.position_m - twice.position_m).norm(), 0.0, 1e-12);
    EXPECT_NEAR((once.velocity_m_s - twice.velocity_m_s).norm(), 0.0, 1e-12);
  }
}

TEST(MotionModels, JacobiansMatchFiniteDifferences) {
  constexpr double kEps = 1e-6;
  for (const auto& model :
       {MotionModel::constant_velocity(), MotionModel::turn(-1.7), MotionModel::turn(0.0),
        MotionModel::deceleration(0.5), MotionModel::deceleration(4.0),
        MotionModel::reversal(1.5, {-1.0, 0.2}), MotionModel::reversal(9.0, {-1.0, 0.2})}) {
    const MotionJacobian j = jacobian(model, kWalker, 0.6);
    for (int axis = 0; axis < 2; ++axis) {
      PlanarState plus = kWalker, minus = kWalker;
      plus.velocity_m_s[axis] += kEps;
      minus.velocity_m_s[axis] -= kEps;
      const PlanarState a = advance(model, plus, 0.6), b = advance(model, minus, 0.6);
      const Vec2 position = (a.position_m - b.position_m) / (2.0 * kEps);
      const Vec2 velocity = (a.velocity_m_s - b.velocity_m_s) / (2.0 * kEps);
      EXPECT_NEAR((j.position_by_velocity.col(axis) - position).norm(), 0.0, 1e-7);
      EXPECT_NEAR((j.velocity_by_velocity.col(axis) - velocity).norm(), 0.0, 1e-7);
    }
  }
}

}  // namespace
}  // namespace foretrack
