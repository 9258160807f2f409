// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/plan_start.hpp"

#include <algorithm>

namespace foretrack {
namespace {

PlanStart measured_start(const VehicleState& vehicle, double time_s, const FlightLimits& limits) {
  PlanStart start;
  start.time_s = time_s;
  const double most_m_s = kPlannedShare * limits.speed_max_m_s;
  const double speed_m_s = vehicle.velocity_enu_m_s.norm();
  start.state.velocity =
      vehicle.velocity_enu_m_s * (speed_m_s > most_m_s ? most_m_s / speed_m_s : 1.0);
  const double ahead_s = std::clamp(time_s - vehicle.stamp_s, 0.0, 0.5);
  start.state.position = vehicle.position_enu_m + ahead_s * start.state.velocity;
  const double most_rad_s = kPlannedShare * limits.yaw_rate_max_rad_s;
  start.yaw.rate_rad_s =
      std::clamp(vehicle.angular_velocity_body_rad_s.z(), -most_rad_s, most_rad_s);
  start.yaw.angle_rad = wrap_angle(vehicle.yaw_rad() + ahead_s * start.yaw.rate_rad_s);
  return start;
}

}  // namespace

PlanStart choose_start(const PlannedTrajectory& flown, const PlanInput& input,
                       const PlanningParams& params) {
  const VehicleState& vehicle = input.vehicle;
  const double time_s = input.now_s + params.horizon.replan_lead_s;
  if (flown.pieces.empty() || !input.flies_plans)
    return measured_start(vehicle, time_s, params.limits);
  const double seen_t = vehicle.stamp_s - flown.start_s;
  const double off_m = (flown.position(seen_t) - vehicle.position_enu_m).norm();
  if (off_m > params.horizon.restart_distance_m)
    return measured_start(vehicle, time_s, params.limits);
  const double t = time_s - flown.start_s;
  PlanStart start;
  start.time_s = time_s;
  start.state = {flown.position(t), flown.velocity(t), flown.acceleration(t)};
  start.yaw = flown.yaw.at(t);
  start.gimbal_pitch = flown.gimbal_pitch.at(t);
  start.on_flown = true;
  return start;
}

}  // namespace foretrack
