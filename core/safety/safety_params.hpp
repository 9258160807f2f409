// SPDX-License-Identifier: Apache-2.0
// Parameters of the gate.
#pragma once

#include "core/common/params.hpp"
#include "core/safety/carry_out.hpp"
#include "core/safety/check_plan.hpp"
#include "core/safety/watch_limits.hpp"
#include "core/safety/watch_odometry.hpp"

namespace foretrack {

/// Defaults are those of the parts that the gate is made of. What each of them means, and its
/// range, is in its row: see rows(), or `foretrack params safety`.
struct SafetyParams {
  // ages, by arrival
  double plan_fresh_s = 0.25;
  double hover_limit_s = 5.0;
  double vehicle_stale_s = 0.3;
  double vehicle_lost_s = 1.0;
  double autopilot_stale_s = 2.0;
  double map_stale_s = 2.0;
  double bodies_stale_s = 1.0;
  double recover_s = 0.5;
  // odometry
  double odometry_jump_m = OdometryParams{}.jump_m;
  double odometry_drift_m = OdometryParams{}.drift_m;
  double odometry_frozen_m = OdometryParams{}.frozen_path_m;
  double odometry_settle_s = OdometryParams{}.settle_s;
  // what a plan may demand, and keep clear of
  double speed_max_m_s = MotionLimits{}.speed_m_s;
  double acceleration_max_m_s2 = MotionLimits{}.acceleration_m_s2;
  double yaw_rate_max_rad_s = MotionLimits{}.yaw_rate_rad_s;
  double vehicle_radius_m = Clearances{}.vehicle_radius_m;
  double obstacle_m = Clearances{}.obstacle_m;
  double body_m = Clearances{}.body_m;
  double bounds_m = Clearances{}.bounds_m;
  bool needs_map = PlanCheckParams{}.needs_map;
  bool heeds_images = true;
  // limits of the flight
  double altitude_min_m = -1000.0;
  double altitude_max_m = 1000.0;
  double battery_reserve = LimitParams{}.battery_reserve;
  double link_timeout_s = LimitParams{}.link_timeout_s;
  int fence_reaction = LimitParams{}.reactions[0];
  int altitude_reaction = LimitParams{}.reactions[1];
  int battery_reaction = LimitParams{}.reactions[2];
  int link_reaction = LimitParams{}.reactions[3];
  // flight
  double max_deviation_m = 1.0;
  double brake_done_m_s = 0.2;
  double response_s = 0.1;
  // orders
  double command_max_age_s = MissionRules{}.max_age_s;
  double command_future_s = MissionRules{}.future_s;
  double lease_s = MissionRules{}.lease_s;
  // the flight controller
  double answer_s = AskParams{}.answer_s;
  double done_s = AskParams{}.done_s;
  double heartbeat_before_s = CarryOutParams{}.heartbeat_before_s;
  double start_patience_s = CarryOutParams{}.patience_s;

  MissionRules mission_rules() const { return {command_max_age_s, command_future_s, lease_s}; }
  CarryOutParams carry_out() const {
    return {{answer_s, done_s}, heartbeat_before_s, start_patience_s};
  }
  OdometryParams odometry() const {
    return {.jump_m = odometry_jump_m,
            .drift_m = odometry_drift_m,
            .frozen_path_m = odometry_frozen_m,
            .settle_s = odometry_settle_s};
  }
  PlanCheckParams plan_check() const {
    PlanCheckParams check;
    check.limits = {speed_max_m_s, acceleration_max_m_s2, yaw_rate_max_rad_s};
    check.clearances = {vehicle_radius_m, obstacle_m, body_m, bounds_m};
    check.needs_map = needs_map;
    return check;
  }
  LimitParams limits() const {
    return {.battery_reserve = battery_reserve,
            .link_timeout_s = link_timeout_s,
            .reactions = {fence_reaction, altitude_reaction, battery_reaction, link_reaction}};
  }
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(SafetyParams& params);

}  // namespace foretrack
