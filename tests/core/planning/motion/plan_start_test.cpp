// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/plan_start.hpp"

#include <gtest/gtest.h>

#include "core/planning/motion/stop_tail.hpp"
#include "tests/core/planning/plan_loop.hpp"

namespace foretrack {
namespace {

PlannedTrajectory eastward(double start_s) {
  PlannedTrajectory trajectory;
  trajectory.start_s = start_s;
  QuinticPiece piece;
  piece.duration_s = 3.0;
  piece.coefficients.row(1) = Vec3(2.0, 0.0, 0.0);
  trajectory.pieces = {piece};
  trajectory.yaw.nodes = {{0.5, 0.0}, {0.5, 0.0}};
  return trajectory;
}

PlanInput input_at(const VehicleState& vehicle) {
  PlanInput input;
  input.now_s = 6.0;
  input.vehicle = vehicle;
  return input;
}

TEST(ChooseStart, IsOnWhatIsFlownAShortTimeAhead) {
  PlanningParams params;
  VehicleState vehicle = testing::hovering({2.1, 0.1, 0.0}, 0.3, 6.0);
  const PlanStart start = choose_start(eastward(5.0), input_at(vehicle), params);
  EXPECT_TRUE(start.on_flown);
  EXPECT_NEAR(start.time_s, 6.0 + params.horizon.replan_lead_s, 1e-12);
  EXPECT_NEAR(start.state.position.x(), 2.0 * (1.0 + params.horizon.replan_lead_s), 1e-9);
  EXPECT_NEAR(start.state.velocity.x(), 2.0, 1e-9);
  EXPECT_NEAR(start.yaw.angle_rad, 0.5, 1e-9);
}

TEST(ChooseStart, IsWhereTheVehicleIsWhenItIsFarFromWhatIsFlown) {
  PlanningParams params;
  VehicleState vehicle = testing::hovering({2.0, 1.0, 0.0}, 0.3, 6.0);
  vehicle.velocity_enu_m_s = {0.0, 1.0, 0.0};
  const PlanStart start = choose_start(eastward(5.0), input_at(vehicle), params);
  EXPECT_FALSE(start.on_flown);
  EXPECT_NEAR(start.state.position.y(), 1.0 + params.horizon.replan_lead_s, 1e-9);
  EXPECT_NEAR(start.yaw.angle_rad, 0.3, 1e-9);
}

TEST(ChooseStart, IsWhereTheVehicleIsWhileItFliesNoPlan) {
  PlanningParams params;
  const VehicleState vehicle = testing::hovering({2.1, 0.1, 0.0}, 0.3, 6.0);
  PlanInput input = input_at(vehicle);
  input.flies_plans = false;
  const PlanStart start = choose_start(eastward(5.0), input, params);
  EXPECT_FALSE(start.on_flown);
  EXPECT_EQ(start.state.position, vehicle.position_enu_m);
  EXPECT_EQ(start.state.velocity, Vec3::Zero());
}

TEST(ChooseStart, BringsMeasuredSpeedsWithinTheLimits) {
  PlanningParams params;
  VehicleState vehicle = testing::hovering(Vec3::Zero(), 0.0, 6.0);
  vehicle.velocity_enu_m_s = {9.0, 0.0, 0.0};
  vehicle.angular_velocity_body_rad_s = {0.0, 0.0, -9.0};
  const PlanStart start = choose_start({}, input_at(vehicle), params);
  EXPECT_LT(start.state.velocity.norm(), params.limits.speed_max_m_s);
  EXPECT_GT(start.state.velocity.norm(), 0.9 * params.limits.speed_max_m_s);
  EXPECT_GT(start.yaw.rate_rad_s, -params.limits.yaw_rate_max_rad_s);
  EXPECT_LT(start.yaw.rate_rad_s, 0.0);
}

}  // namespace
}  // namespace foretrack
