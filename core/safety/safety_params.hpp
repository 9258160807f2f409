// SPDX-License-Identifier: Apache-2.0
// Parameters of the gate.
#pragma once

#include "core/common/params.hpp"
#include "core/safety/carry_out.hpp"
#include "core/safety/check_plan.hpp"
#include "core/safety/watch_limits.hpp"
#include "core/safety/watch_odometry.hpp"

namespace foretrack {

/// What each of them means, and its range, is in its row: see rows(), or `foretrack params safety`.
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
  double odometry_jump_m = 0.5;
  double odometry_drift_m = 0.5;
  double odometry_frozen_m = 0.6;
  double odometry_settle_s = 1.0;
  // what a plan may demand, and keep clear of
  double speed_max_m_s = 3.0;
  double acceleration_max_m_s2 = 5.0;
  double yaw_rate_max_rad_s = 2.0;
  double vehicle_radius_m = 0.25;
  double obstacle_m = 0.30;
  double body_m = 0.3;
  double bounds_m = 0.5;
  bool needs_map = true;
  // limits of the flight
  double altitude_min_m = -1000.0;
  double altitude_max_m = 1000.0;
  double battery_reserve = 0.15;
  double link_timeout_s = 0.0;
  int fence_reaction = 1;
  int altitude_reaction = 1;
  int battery_reaction = 2;
  int link_reaction = 1;
  // flight
  double max_deviation_m = 1.0;
  double brake_done_m_s = 0.2;
  double response_s = 0.1;
  // orders
  double command_max_age_s = 1.0;
  double command_future_s = 0.5;
  double lease_s = 5.0;
  // the flight controller
  double answer_s = 1.5;
  double done_s = 4.0;
  double heartbeat_before_s = 1.2;
  double start_patience_s = 30.0;

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
