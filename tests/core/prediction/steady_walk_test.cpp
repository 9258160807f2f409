#include "core/prediction/steady_walk.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.04;

// Follows a walk at these velocities; the estimates err as a filter's do: slowly.
struct Follower {
  PredictionParams params;
  SteadyWalk walk;
  Random random{5};
  PlanarState truth, measured;
  Vec2 error_m = Vec2::Zero(), error_m_s = Vec2::Zero();
  double noise_m_s = 0.0, now_s = 0.0;

  void step(const Vec2& velocity_m_s, double body_swing_rad = 0.0) {
    now_s += kStep_s;
    truth.velocity_m_s = velocity_m_s;
    truth.position_m += kStep_s * velocity_m_s;
    error_m_s = 0.8 * error_m_s + 0.6 * noise_m_s * Vec2(random.normal(), random.normal());
    error_m = 0.8 * error_m + kStep_s * error_m_s;
    measured = {truth.position_m + error_m, truth.velocity_m_s + error_m_s};
    follow(walk, measured, now_s, body_swing_rad, params);
  }
  PlanarState state() const { return walk.state(measured); }
};

TEST(SteadyWalk, IsExactForWhoWalksStraightOn) {
  Follower f;
  for (int i = 0; i < 100; ++i) f.step({1.2, -0.7});
  EXPECT_NEAR((f.state().position_m - f.truth.position_m).norm(), 0.0, 1e-9);
  EXPECT_NEAR((f.state().velocity_m_s - Vec2(1.2, -0.7)).norm(), 0.0, 1e-9);
}

TEST(SteadyWalk, TakesMostOfTheNoiseOutOfTheVelocity) {
  Follower f;
  f.noise_m_s = 0.2;
  double smoothed = 0.0, measured = 0.0;
  for (int i = 0; i < 2000; ++i) {
    f.step({1.5, 0.0});
    smoothed += (f.state().velocity_m_s - f.truth.velocity_m_s).squaredNorm();
    measured += (f.measured.velocity_m_s - f.truth.velocity_m_s).squaredNorm();
  }
  EXPECT_LT(std::sqrt(smoothed), 0.5 * std::sqrt(measured));
}

TEST(SteadyWalk, ForgetsAtATurnThatTheVelocityOrTheChestTells) {
  Follower f;
  for (int i = 0; i < 50; ++i) f.step({1.5, 0.0});
  Follower g = f;
  f.step({0.0, 1.5});
  EXPECT_EQ(f.state().velocity_m_s, f.measured.velocity_m_s);
  g.step({1.45, 0.4}, 0.7);
  EXPECT_EQ(g.state().velocity_m_s, g.measured.velocity_m_s);
}

TEST(SteadyWalk, LagsASuddenStopByLittle) {
  Follower f;
  for (int i = 0; i < 50; ++i) f.step({1.5, 0.0});
  double latest_s = 0.0;
  for (int i = 1; i <= 25; ++i) {
    const double speed = std::max(0.0, 1.5 - 3.0 * i * kStep_s);
    f.step({speed, 0.0});
    const double late_m_s = f.state().velocity_m_s.x() - speed;
    if (speed > 0.0) latest_s = std::max(latest_s, late_m_s / 3.0);
  }
  EXPECT_LT(latest_s, 0.13);
}

TEST(SteadyWalk, StartsAnewAfterAGapOrAStepBackInTime) {
  for (const double next_s : {0.5, 9.0}) {
    Follower f;
    for (int i = 0; i < 50; ++i) f.step({1.5, 0.0});
    const PlanarState elsewhere{{7.0, 7.0}, {0.0, 1.0}};
    follow(f.walk, elsewhere, next_s, 0.0, f.params);
    EXPECT_EQ(f.walk.state(elsewhere).position_m, elsewhere.position_m);
    EXPECT_EQ(f.walk.memory_s, 0.0);
  }
}

}  // namespace
}  // namespace foretrack
