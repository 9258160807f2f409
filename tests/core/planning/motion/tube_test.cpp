// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/tube.hpp"

#include <gtest/gtest.h>

#include "core/planning/plan_params.hpp"

namespace foretrack {
namespace {

TEST(Tube, IsHullAndDeviationAndTheMapsErrorAndNeverLessThanTheCheckAsks) {
  PlanningParams params;
  const DeviationBound deviation;
  const Tube tube = make_tube(params, 0.2, deviation);
  EXPECT_DOUBLE_EQ(tube.radius_m(2.0, 1.0),
                   params.body.hull_radius_m + deviation.bound_m(2.0, 1.0) + 0.1);
  EXPECT_EQ(tube.radius_m(0.2, 0.0), params.check.vehicle_radius_m);
  params.check.vehicle_radius_m = 0.8;
  EXPECT_EQ(make_tube(params, 0.2, deviation).radius_m(2.0, 1.0), 0.8);
}

TEST(Tube, TellsHowFastANarrowWayMayBeFlown) {
  Tube tube;
  for (double radius_m = tube.least_m; radius_m < 0.5; radius_m += 0.005) {
    const double speed_m_s = tube.speed_within_m_s(radius_m);
    EXPECT_LE(tube.radius_m(speed_m_s), radius_m + 1e-9);
    EXPECT_GE(speed_m_s, tube.slow_m_s);
  }
  EXPECT_EQ(tube.speed_within_m_s(0.0), tube.slow_m_s) << "the check decides whether at all";
  EXPECT_GT(tube.speed_within_m_s(0.9), 100.0);
  const double before_m_s = tube.speed_within_m_s(0.45);
  for (int i = 0; i < 100; ++i) tube.deviation.add(1.0, 0.0, 0.2);
  EXPECT_LT(tube.speed_within_m_s(0.45), 0.7 * before_m_s) << "this vehicle flies less exactly";
}

}  // namespace
}  // namespace foretrack
