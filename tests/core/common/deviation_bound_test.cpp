// SPDX-License-Identifier: Apache-2.0
#include "core/common/deviation_bound.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kSpeed_m_s = 2.0, kGentle_m_s2 = 1.0, kHard_m_s2 = 4.0;

TEST(DeviationBound, AHundredthOfTheDeviationsIsGreater) {
  DeviationBound bound;
  Random random(1);
  int greater = 0;
  for (int i = 0; i < 20000; ++i) {
    const double deviation_m = std::abs(0.06 * random.normal());
    if (i >= 5000) greater += deviation_m > bound.bound_m(kSpeed_m_s, kGentle_m_s2);
    bound.add(kSpeed_m_s, kGentle_m_s2, deviation_m);
  }
  EXPECT_NEAR(greater / 15000.0, 0.01, 0.003);
  EXPECT_NEAR(bound.bound_m(kSpeed_m_s, kGentle_m_s2), 2.576 * 0.06, 0.04);
}

TEST(DeviationBound, IsLearntForEachKindOfMotionApart) {
  DeviationBound bound;
  const double before_m = bound.bound_m(kSpeed_m_s, kGentle_m_s2);
  for (int i = 0; i < 100; ++i) bound.add(kSpeed_m_s, kHard_m_s2, 0.25);
  EXPECT_NEAR(bound.bound_m(kSpeed_m_s, kHard_m_s2), 0.25, 0.03);
  EXPECT_EQ(bound.bound_m(kSpeed_m_s, kGentle_m_s2), before_m);
  EXPECT_LT(bound.bound_m(0.0, 0.0), before_m) << "at rest it is narrower";
}

TEST(DeviationBound, WhatIsNoDeviationOrBeyondMeasureDoesNoHarm) {
  DeviationBound bound;
  bound.add(kSpeed_m_s, kGentle_m_s2, std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < 1000; ++i) bound.add(kSpeed_m_s, kGentle_m_s2, 50.0);
  EXPECT_LE(bound.bound_m(kSpeed_m_s, kGentle_m_s2), 0.3);
  for (int i = 0; i < 100000; ++i) bound.add(kSpeed_m_s, kGentle_m_s2, 0.0);
  EXPECT_GT(bound.bound_m(kSpeed_m_s, kGentle_m_s2), 0.0);
}

// What a slower plan leaves no less than a faster one is an accident of the measurement.
TEST(DeviationBound, GrowsWithTheSpeed) {
  DeviationBound bound;
  for (int i = 0; i < 200; ++i) bound.add(1.0, kGentle_m_s2, 0.2);
  EXPECT_GE(bound.bound_m(2.0, kGentle_m_s2), bound.bound_m(1.0, kGentle_m_s2));
  double before_m = 0.0;
  for (double speed_m_s = 0.0; speed_m_s < 4.0; speed_m_s += 0.05) {
    const double bound_m = bound.bound_m(speed_m_s);
    EXPECT_GE(bound_m, before_m);
    EXPECT_GE(bound_m, bound.bound_m(speed_m_s, kHard_m_s2));
    before_m = bound_m;
  }
}

TEST(DeviationBound, WhoIsLateOnThePathIsNotOffIt) {
  PlannedTrajectory plan;
  QuinticPiece piece;
  piece.duration_s = 2.0;
  piece.coefficients.row(1) = Vec3(2.0, 0.0, 0.0).transpose();
  plan.pieces = {piece};
  DeviationBound late, off;
  for (int i = 0; i < 200; ++i) late.add(plan, 1.0, {1.75, 0.0, 0.0});
  EXPECT_LT(late.bound_m(2.0, 0.0), DeviationBound().bound_m(2.0, 0.0));
  for (int i = 0; i < 200; ++i) off.add(plan, 1.0, {1.75, 0.2, 0.0});
  EXPECT_NEAR(off.bound_m(2.0, 0.0), 0.2, 0.03);
}

}  // namespace
}  // namespace foretrack
