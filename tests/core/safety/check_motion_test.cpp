// SPDX-License-Identifier: Apache-2.0
#include "core/safety/check_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/common/random.hpp"
#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Boundary {
  Vec3 position, velocity, acceleration;
};

/// The quintic between two states.
QuinticPiece between(const Boundary& a, const Boundary& b, double duration_s) {
  const double T = duration_s, T2 = T * T, T3 = T2 * T;
  QuinticPiece piece{.duration_s = T};
  const Vec3 d = b.position - a.position - T * a.velocity - 0.5 * T2 * a.acceleration;
  const Vec3 v = b.velocity - a.velocity - T * a.acceleration;
  const Vec3 c = b.acceleration - a.acceleration;
  piece.coefficients.row(0) = a.position;
  piece.coefficients.row(1) = a.velocity;
  piece.coefficients.row(2) = 0.5 * a.acceleration;
  piece.coefficients.row(3) = (10.0 * d - 4.0 * T * v + 0.5 * T2 * c) / T3;
  piece.coefficients.row(4) = (-15.0 * d + 7.0 * T * v - T2 * c) / (T3 * T);
  piece.coefficients.row(5) = (6.0 * d - 3.0 * T * v + 0.5 * T2 * c) / (T3 * T2);
  return piece;
}

/// Some pieces of random motion, near the limits, to rest.
PlannedTrajectory random_plan(Random& random) {
  const auto vector = [&](double scale) {
    return Vec3(random.uniform(-scale, scale), random.uniform(-scale, scale),
                random.uniform(-scale, scale));
  };
  PlannedTrajectory plan;
  plan.id = 1;
  Boundary from{vector(5.0), vector(1.2), vector(1.5)};
  const int pieces = 1 + static_cast<int>(random.uniform(0.0, 4.0));
  for (int i = 0; i < pieces; ++i) {
    const double duration_s = random.uniform(0.4, 1.5);
    const bool last = i + 1 == pieces;
    const Boundary to{from.position + duration_s * 0.6 * from.velocity + vector(0.4),
                      last ? Vec3::Zero() : vector(1.2), last ? Vec3::Zero() : vector(1.5)};
    plan.pieces.push_back(between(from, to, duration_s));
    from = to;
  }
  double rate_rad_s = random.uniform(-2.2, 2.2), angle_rad = random.uniform(-3.0, 3.0);
  plan.yaw.nodes = {{angle_rad, rate_rad_s}};
  for (int i = 0; i < 10; ++i) {
    const double next_rad_s = rate_rad_s + random.uniform(-0.5, 0.5);
    angle_rad += 0.5 * (rate_rad_s + next_rad_s) * plan.yaw.dt_s;
    rate_rad_s = next_rad_s;
    plan.yaw.nodes.push_back({angle_rad, rate_rad_s});
  }
  return plan;
}

struct Peaks {
  double speed = 0.0, acceleration = 0.0, yaw_rate = 0.0;
};
Peaks sampled(const PlannedTrajectory& plan) {
  constexpr int kSamples = 1000;  // a piece, with both its ends
  Peaks peaks;
  for (const QuinticPiece& piece : plan.pieces)
    for (int i = 0; i <= kSamples; ++i) {
      const double t = piece.duration_s * i / kSamples;
      peaks.speed = std::max(peaks.speed, piece.velocity(t).norm());
      peaks.acceleration = std::max(peaks.acceleration, piece.acceleration(t).norm());
    }
  const double turns_s = plan.yaw.dt_s * static_cast<double>(plan.yaw.nodes.size() - 1);
  for (double t = 0.0; t <= turns_s; t += 1e-3)  // it may be longer than the motion
    peaks.yaw_rate = std::max(peaks.yaw_rate, std::abs(plan.yaw.at(t).rate_rad_s));
  return peaks;
}

TEST(CheckMotion, WhateverPassesObeysTheLimitsAtEverySampleAndWhatObeysThemPasses) {
  Random random(7);
  const MotionLimits limits;
  int passed = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const PlannedTrajectory plan = random_plan(random);
    ASSERT_EQ(check_shape(plan), PlanFault::kNone);
    const Peaks peaks = sampled(plan);
    const bool obeys = peaks.speed <= 3.0 && peaks.acceleration <= 5.0 && peaks.yaw_rate <= 2.0;
    const bool near = std::abs(peaks.speed - 3.0) < 0.004 ||
                      std::abs(peaks.acceleration - 5.0) < 0.007 ||
                      std::abs(peaks.yaw_rate - 2.0) < 0.05;
    const bool passes = check_limits(plan, limits) == PlanFault::kNone;
    if (passes) {
      EXPECT_LE(peaks.speed, 3.0 * 1.0011);
      EXPECT_LE(peaks.acceleration, 5.0 * 1.0011);
      EXPECT_LE(peaks.yaw_rate, 2.0 * 1.0011);
    }
    EXPECT_TRUE(near || passes == obeys) << i;
    ++(passes ? passed : refused);
  }
  EXPECT_GT(passed, 300);
  EXPECT_GT(refused, 300);
}

TEST(CheckMotion, TellsTooFastFromTooHardFromTurningTooFast) {
  PlannedTrajectory plan = straight_plan(1, 0.0);
  EXPECT_EQ(check_limits(plan, {}), PlanFault::kNone);
  EXPECT_EQ(check_limits(plan, {.speed_m_s = 0.4}), PlanFault::kTooFast);
  EXPECT_EQ(check_limits(plan, {.acceleration_m_s2 = 0.5}), PlanFault::kTooHard);
  plan.yaw.nodes = {{0.0, 2.1}, {0.21, 2.1}};
  EXPECT_EQ(check_limits(plan, {}), PlanFault::kTurnsTooFast);
}

TEST(CheckMotion, AcceptsAPeakThatOnlyTouchesItsLimit) {
  const PlannedTrajectory plan = straight_plan(1, 0.0);  // 0.5 m/s, and brakes with at most 0.75
  EXPECT_EQ(check_limits(plan, {.speed_m_s = 0.5, .acceleration_m_s2 = 0.75}), PlanFault::kNone);
  EXPECT_EQ(check_limits(plan, {.speed_m_s = 0.4998}), PlanFault::kNone) << "within tolerance";
  EXPECT_EQ(check_limits(plan, {.acceleration_m_s2 = 0.745}), PlanFault::kTooHard);
}

TEST(CheckMotion, RefusesAPeakThatIsAboveTheLimitByLessThanItCanTell) {
  // v = most + 1e-9 − (t − 1/3)² / 10 is above at no place where the halvings look.
  const double most_m_s = 1.001;
  QuinticPiece piece{.duration_s = 1.0};
  piece.coefficients(1, 0) = most_m_s + 1e-9 - 0.1 / 9.0;
  piece.coefficients(2, 0) = 0.1 / 3.0;
  piece.coefficients(3, 0) = -0.1 / 3.0;
  PlannedTrajectory plan = straight_plan(1, 0.0);
  plan.pieces = {piece};
  EXPECT_EQ(check_limits(plan, {.speed_m_s = 1.0}), PlanFault::kTooFast);
  EXPECT_EQ(check_limits(plan, {.speed_m_s = 1.0001}), PlanFault::kNone);
}

TEST(CheckMotion, RefusesAPlanWithoutAStop) {
  PlannedTrajectory plan = straight_plan(1, 0.0);
  plan.pieces.pop_back();
  EXPECT_EQ(check_shape(plan), PlanFault::kEndsInMotion);
  plan = straight_plan(1, 0.0);
  plan.pieces.back().coefficients.row(5) = Vec3(0.0, 0.0, 0.02);  // it still moves
  EXPECT_EQ(check_shape(plan), PlanFault::kEndsInMotion);
  plan = straight_plan(1, 0.0);
  plan.pieces.back().coefficients.row(4) += Vec3(0.0, 0.0, -0.125);
  plan.pieces.back().coefficients.row(5) += Vec3(0.0, 0.0, 0.1);  // at rest, it still accelerates
  EXPECT_EQ(check_shape(plan), PlanFault::kEndsInMotion);
}

TEST(CheckMotion, RefusesPiecesThatDoNotJoin) {
  for (int row = 0; row < 3; ++row) {
    PlannedTrajectory plan = straight_plan(1, 0.0);
    plan.pieces[1].coefficients(row, 1) += row == 2 ? 0.2 : 0.1;
    EXPECT_EQ(check_shape(plan), PlanFault::kBroken) << row;
  }
}

TEST(CheckMotion, RefusesAYawThatJumpsOrIsNotThere) {
  PlannedTrajectory plan = straight_plan(1, 0.0);
  plan.yaw.nodes = {{0.0, 0.0}, {0.5, 0.0}};
  EXPECT_EQ(check_shape(plan), PlanFault::kBroken);
  plan.yaw.nodes.clear();
  EXPECT_EQ(check_shape(plan), PlanFault::kBroken);
}

TEST(CheckMotion, RefusesWhatIsNotFiniteOrNoPlace) {
  const auto broken = [](auto&& how) {
    PlannedTrajectory plan = straight_plan(1, 0.0);
    how(plan);
    return check_shape(plan);
  };
  using P = PlannedTrajectory;
  for (const double bad : {std::nan(""), kInf}) {
    EXPECT_EQ(broken([&](P& p) { p.pieces[1].coefficients(3, 2) = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.pieces[0].duration_s = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.yaw.nodes[0].angle_rad = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.yaw.nodes[0].rate_rad_s = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.yaw.dt_s = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.start_s = bad; }), PlanFault::kNotFinite);
    EXPECT_EQ(broken([&](P& p) { p.stamp_s = bad; }), PlanFault::kNotFinite);
  }
  EXPECT_EQ(broken([](P& p) { p.pieces[0].duration_s = 0.0; }), PlanFault::kNotFinite);
  EXPECT_EQ(broken([](P& p) { p.yaw.dt_s = 0.0; }), PlanFault::kNotFinite);
  EXPECT_EQ(broken([](P& p) { p.pieces[0].coefficients(0, 0) = 1e7; }), PlanFault::kNotFinite);
  EXPECT_EQ(broken([](P& p) { p.pieces[1].coefficients(5, 0) = 1e9; }), PlanFault::kNotFinite);
}

TEST(CheckMotion, RefusesWhatIsLargerThanWhatIsFlown) {
  PlannedTrajectory plan = straight_plan(1, 0.0);
  plan.yaw.nodes.resize(513, {0.0, 0.0});
  EXPECT_EQ(check_shape(plan), PlanFault::kTooLarge);
  plan = straight_plan(1, 0.0);
  plan.pieces.resize(65, plan.pieces.back());
  EXPECT_EQ(check_shape(plan), PlanFault::kTooLarge);
  plan = still_plan(1, 0.0, Vec3::Zero());
  plan.pieces[0].duration_s = 40.0;
  plan.pieces.resize(2, plan.pieces[0]);
  EXPECT_EQ(check_shape(plan), PlanFault::kTooLarge);
}

TEST(CheckMotion, JoinsWithinEachTolerance) {
  const PlannedTrajectory plan = straight_plan(1, 0.0);
  const Joint exact{Vec3(0, 0, 1.5), Vec3(0.5, 0, 0), Vec3::Zero(), 0.0};
  const JointTolerance tolerance{0.1, 0.1, 0.1, 0.1};
  EXPECT_TRUE(joins(plan, exact, tolerance));
  for (int i = 0; i < 4; ++i) {
    Joint off = exact;
    if (i == 0) off.position_enu_m.y() = 0.2;
    if (i == 1) off.velocity_enu_m_s.z() = 0.2;
    if (i == 2) off.acceleration_enu_m_s2.x() = 0.2;
    if (i == 3) off.yaw_rad = 0.2;
    EXPECT_FALSE(joins(plan, off, tolerance)) << i;
  }
  Joint turned = exact;
  turned.yaw_rad = 2.0 * kPi;
  EXPECT_TRUE(joins(plan, turned, tolerance));
}

TEST(CheckMotion, EveryFaultHasAName) {
  for (int i = 1; i < kPlanFaultCount; ++i)
    EXPECT_FALSE(to_string(static_cast<PlanFault>(i)).empty());
}

}  // namespace
}  // namespace foretrack::testing
