// SPDX-License-Identifier: Apache-2.0
// Parameters of the gate.
#pragma once

#include "core/common/params.hpp"
#include "core/safety/carry_out.hpp"
#include "core/safety/check_plan.hpp"
#include "core/safety/watch_limits.hpp"
#include "core/safety/watch_odometry.hpp"

namespace foretrack {

/// Defaults are those of the parts that the gate is made of. Ranges are in the rows: see rows(), or
/// `foretrack params safety`.
struct SafetyParams {
  // ages, by arrival
  double plan_fresh_s = 0.25;      ///< a plan older than this coasts
  double hover_limit_s = 5.0;      ///< without any plan for this long the heartbeat stops
  double vehicle_stale_s = 0.3;    ///< without a vehicle state for so long: brake
  double vehicle_lost_s = 1.0;     ///< and for so long: silence
  double autopilot_stale_s = 2.0;  ///< longest silence of the flight controller
  double map_stale_s = 2.0;        ///< an older map is none
  double bodies_stale_s = 1.0;     ///< people around that are older are none
  double recover_s = 0.5;          ///< a fault must be away for so long before it counts as over
  // odometry
  /// from one vehicle state to the next, beyond what its velocity tells: brake
  double odometry_jump_m = OdometryParams{}.jump_m;
  double odometry_drift_m = OdometryParams{}.drift_m;  ///< the same, summed up over a second
  /// the vehicle stands still while so much motion is commanded: brake
  double odometry_frozen_m = OdometryParams{}.frozen_path_m;
  /// odometry is believed again after so long without faults
  double odometry_settle_s = OdometryParams{}.settle_s;
  // what a plan may demand, and keep clear of
  double speed_max_m_s = MotionLimits{}.speed_m_s;  ///< a faster plan is refused
  /// a plan that accelerates harder is refused
  double acceleration_max_m_s2 = MotionLimits{}.acceleration_m_s2;
  /// a plan that turns faster is refused
  double yaw_rate_max_rad_s = MotionLimits{}.yaw_rate_rad_s;
  double vehicle_radius_m = Clearances{}.vehicle_radius_m;  ///< of the vehicle's hull
  /// least distance of a plan to what is occupied or unknown; more at speeds at which the vehicle
  /// is measured to leave its plans by more
  double obstacle_m = Clearances{}.obstacle_m;
  double obstacle_most_m = Clearances{}.obstacle_most_m;  ///< but never more than that
  /// least gap of a plan to people and vehicles, unless nothing else is farther away
  double body_m = Clearances{}.body_m;
  double bounds_m = Clearances{}.bounds_m;  ///< so far inside of fence and altitudes plans stay
  /// a plan that leads lower over the ground below is refused
  double least_altitude_m = Clearances{}.least_altitude_m;
  bool needs_map = PlanCheckParams{}.needs_map;  ///< without a map no plan is flown
  bool heeds_images = true;  ///< hover while colour or depth images are frozen, dark or covered
  // limits of the flight
  double altitude_min_m = -1000.0;  ///< least altitude of the flight, over the ground below
  double altitude_max_m = 1000.0;   ///< greatest altitude of the flight, over the ground below
  /// share of the battery that is kept; 0: not watched
  double battery_reserve = LimitParams{}.battery_reserve;
  /// longest silence of the operator; 0: none is asked for
  double link_timeout_s = LimitParams{}.link_timeout_s;
  /// outside of the fence: 0 none, 1 hold, 2 return, 3 land
  int fence_reaction = LimitParams{}.reactions[0];
  int altitude_reaction = LimitParams{}.reactions[1];  ///< outside of the altitudes, the same
  int battery_reaction = LimitParams{}.reactions[2];   ///< at the battery's reserve, the same
  int link_reaction = LimitParams{}.reactions[3];      ///< without word from the operator, the same
  // flight
  double max_deviation_m = 1.0;  ///< farther than this from the flown trajectory: brake
  double brake_done_m_s = 0.2;   ///< below this speed a position is held
  /// time in which the vehicle's tilt follows; accelerations are commanded so much ahead
  double response_s = 0.1;
  // orders
  double command_max_age_s = MissionRules{}.max_age_s;  ///< older commands are refused
  /// commands stamped farther ahead are refused
  double command_future_s = MissionRules{}.future_s;
  /// an operator's lease ends that long after it was last renewed
  double lease_s = MissionRules{}.lease_s;
  /// an operator may order no smaller distance to the person
  double framing_distance_min_m = FramingLimits{}.distance_min_m;
  double framing_distance_max_m = FramingLimits{}.distance_max_m;  ///< and no greater one
  /// an operator may order no lower flight, above the middle of the person's torso
  double framing_height_min_m = FramingLimits{}.height_min_m;
  double framing_height_max_m = FramingLimits{}.height_max_m;  ///< and no higher one
  /// an operator may let the vehicle circle no faster
  double framing_circling_max_rad_s = FramingLimits{}.circling_max_rad_s;
  // the flight controller
  /// a request that the flight controller does not answer for so long is given up
  double answer_s = AskParams{}.answer_s;
  double done_s = AskParams{}.done_s;  ///< so is one that it accepted, but does not do for so long
  /// unbroken heartbeat before offboard mode is asked for
  double heartbeat_before_s = CarryOutParams{}.heartbeat_before_s;
  /// an order to start ends that long after it, unless target, map and plan have come
  double start_patience_s = CarryOutParams{}.patience_s;

  MissionRules mission_rules() const {
    return {command_max_age_s,
            command_future_s,
            lease_s,
            {framing_distance_min_m, framing_distance_max_m, framing_height_min_m,
             framing_height_max_m, framing_circling_max_rad_s}};
  }
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
    check.clearances = {vehicle_radius_m, obstacle_m, obstacle_most_m,
                        body_m,           bounds_m,   least_altitude_m};
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
