// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/quadrotor.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace foretrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Setpoint place(const Vec3& p, double yaw = 0.0) {
  Setpoint s;
  s.position_enu_m = p;
  s.yaw_rad = yaw;
  return s;
}

void fly(QuadrotorState& state, const Setpoint& setpoint, double for_s,
         const WindParams& wind = {}) {
  for (int i = 0; i < std::lround(for_s / 0.01); ++i)
    fly_setpoint({}, wind, state, setpoint, true, 0.01);
}

TEST(Quadrotor, HoversWithoutMoving) {
  auto state = make_quadrotor({}, {1, 2, 3}, 0.7, 1);
  fly(state, place({1, 2, 3}, 0.7), 5.0);
  EXPECT_LT((state.vehicle.position_enu_m - Vec3(1, 2, 3)).norm(), 1e-6);
  EXPECT_NEAR(state.vehicle.yaw_rad(), 0.7, 1e-9);
}

TEST(Quadrotor, FallsAsTheDragLawSays) {
  // Unarmed, motors at rest: v(t) = −(m g / d)(1 − e^(−d t / m)).
  const QuadrotorParams params;
  auto state = make_quadrotor(params, {0, 0, 100}, 0.0, 1);
  state.thrusts_n.fill(0.0);
  for (int i = 0; i < 200; ++i) fly_setpoint(params, {}, state, {}, false, 0.01);
  const double m = params.mass_kg, d = params.drag_n_s_m;
  const double expected = -(m * kGravity_m_s2 / d) * (1.0 - std::exp(-d * 2.0 / m));
  EXPECT_NEAR(state.vehicle.velocity_enu_m_s.z(), expected, 0.01);
}

TEST(Quadrotor, SpinsAsEulersEquationsSay) {
  // Torque-free, unarmed: the angular momentum in the world is kept.
  const QuadrotorParams params;
  auto state = make_quadrotor(params, {0, 0, 100}, 0.0, 1);
  state.thrusts_n.fill(0.0);
  state.vehicle.angular_velocity_body_rad_s = {2.0, -1.0, 3.0};
  const auto momentum = [&]() -> Vec3 {
    return state.vehicle.q_world_body *
           params.inertia_kg_m2.cwiseProduct(state.vehicle.angular_velocity_body_rad_s);
  };
  const Vec3 before = momentum();
  for (int i = 0; i < 100; ++i) fly_setpoint(params, {}, state, {}, false, 0.01);
  EXPECT_LT((momentum() - before).norm(), 0.02 * before.norm());
}

TEST(Quadrotor, MixIsTheInverseOfTheMotorsWithinTheirLimits) {
  const QuadrotorParams p;
  const Wrench wrench{10.0, {0.05, -0.08, 0.01}};
  const auto f = mix(p, wrench);
  EXPECT_NEAR(f[0] + f[1] + f[2] + f[3], 10.0, 1e-9);
  EXPECT_NEAR(p.arm_m * (f[0] - f[1] - f[2] + f[3]), 0.05, 1e-9);
  EXPECT_NEAR(p.arm_m * (-f[0] + f[1] - f[2] + f[3]), -0.08, 1e-9);
  EXPECT_NEAR(p.torque_per_thrust_m * (f[0] + f[1] - f[2] - f[3]), 0.01, 1e-9);
  for (const double thrust : mix(p, {30.0, {5, 5, 5}})) {
    EXPECT_GE(thrust, 0.0);
    EXPECT_LE(thrust, p.motor_thrust_max_n);
  }
}

TEST(Quadrotor, StepsToAPlaceWithoutOvershootingMuch) {
  auto state = make_quadrotor({}, {0, 0, 2}, 0.0, 1);
  double furthest = 0.0;
  for (int i = 0; i < 800; ++i) {
    fly_setpoint({}, {}, state, place({2, 0, 2}), true, 0.01);
    furthest = std::max(furthest, state.vehicle.position_enu_m.x());
  }
  EXPECT_NEAR(state.vehicle.position_enu_m.x(), 2.0, 0.05);
  EXPECT_LT(furthest, 2.6);
  EXPECT_NEAR(state.vehicle.position_enu_m.z(), 2.0, 0.05);
}

TEST(Quadrotor, FollowsATrajectoryWithFeedForwardClosely) {
  // A circle of 2 m radius at 1.5 m/s, entered at speed.
  auto state = make_quadrotor({}, {2, 0, 2}, 0.0, 1);
  state.vehicle.velocity_enu_m_s = {0, 1.5, 0};
  const double w = 1.5 / 2.0;
  double worst = 0.0;
  for (int i = 0; i < 800; ++i) {
    const double t = 0.01 * (i + 1), c = std::cos(w * t), s = std::sin(w * t);
    Setpoint sp = place({2 * c, 2 * s, 2}, w * t);
    sp.velocity_enu_m_s = {-1.5 * s, 1.5 * c, 0};
    sp.acceleration_enu_m_s2 = {-w * 1.5 * c, -w * 1.5 * s, 0};
    sp.yaw_rate_rad_s = w;
    fly_setpoint({}, {}, state, sp, true, 0.01);
    worst = std::max(worst, (state.vehicle.position_enu_m - sp.position_enu_m).norm());
  }
  EXPECT_LT(worst, 0.15);
  EXPECT_NEAR(wrap_angle(state.vehicle.yaw_rad() - w * 8.0), 0.0, 0.05);
}

TEST(Quadrotor, VelocityAloneIsFlownWherePositionIsNaN) {
  auto state = make_quadrotor({}, {0, 0, 2}, 0.0, 1);
  Setpoint sp = place({kNaN, kNaN, 2.0});
  sp.velocity_enu_m_s = {1.0, 0, 0};
  sp.acceleration_enu_m_s2.setConstant(kNaN);
  fly(state, sp, 5.0);
  EXPECT_NEAR(state.vehicle.velocity_enu_m_s.x(), 1.0, 0.05);
  EXPECT_NEAR(state.vehicle.position_enu_m.z(), 2.0, 0.05);
}

TEST(Quadrotor, KeepsTheTiltLimit) {
  const QuadrotorParams params;
  auto state = make_quadrotor(params, {0, 0, 5}, 0.0, 1);
  double tilt = 0.0;
  for (int i = 0; i < 300; ++i) {
    fly_setpoint(params, {}, state, place({100, 0, 5}), true, 0.01);
    tilt = std::max(tilt, std::acos((state.vehicle.q_world_body * Vec3::UnitZ()).z()));
  }
  EXPECT_GT(tilt, 0.5 * params.tilt_max_rad);
  EXPECT_LT(tilt, params.tilt_max_rad + rad(5.0));
}

TEST(Quadrotor, HoldsItsPlaceInWindByLeaningIntoIt) {
  auto state = make_quadrotor({}, {0, 0, 2}, 0.0, 1);
  fly(state, place({0, 0, 2}), 15.0, {.mean_enu_m_s = {4, 0, 0}});
  EXPECT_LT(distance_xy(state.vehicle.position_enu_m, {0, 0, 2}), 0.1);
  EXPECT_LT((state.vehicle.q_world_body * Vec3::UnitZ()).x(), -0.05);
}

TEST(Quadrotor, GustsFollowTheSeedAndTheirStrength) {
  const WindParams wind{.gust_m_s = 1.5, .gust_time_s = 0.5};
  auto a = make_quadrotor({}, {0, 0, 2}, 0.0, 7), b = a, c = make_quadrotor({}, {0, 0, 2}, 0.0, 8);
  double square = 0.0;
  for (int i = 0; i < 20000; ++i) {
    fly_setpoint({}, wind, a, place({0, 0, 2}), true, 0.01);
    square += a.gust_enu_m_s.x() * a.gust_enu_m_s.x() / 20000.0;
  }
  EXPECT_NEAR(std::sqrt(square), 1.5, 0.15);
  fly(b, place({0, 0, 2}), 200.0, wind);
  fly(c, place({0, 0, 2}), 1.0, wind);
  EXPECT_EQ(a.vehicle.position_enu_m, b.vehicle.position_enu_m);
  EXPECT_NE(a.vehicle.position_enu_m, c.vehicle.position_enu_m);
}

}  // namespace
}  // namespace foretrack
