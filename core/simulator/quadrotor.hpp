// SPDX-License-Identifier: Apache-2.0
// A quadrotor as a rigid body: four lagging motors, drag in the wind, and the cascade of a flight
// controller that flies setpoints.
#pragma once

#include <array>

#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"

namespace foretrack {

struct QuadrotorParams {
  double mass_kg = 1.0;
  Vec3 inertia_kg_m2 = Vec3(0.008, 0.008, 0.014);
  double arm_m = 0.12;  // of each motor from the axes, forward and sideways
  double torque_per_thrust_m = 0.016;
  double motor_lag_s = 0.03;
  double motor_thrust_max_n = 6.0;
  double drag_n_s_m = 0.20;  // linear in the speed through the air
  // Cascade: position → velocity → acceleration → attitude → body rates, gains 1/s.
  double position_gain = 1.5;
  double velocity_gain = 3.0;
  double velocity_integral_gain = 0.6;
  double attitude_gain = 7.0;
  double yaw_gain = 3.0;
  double rate_gain = 20.0;
  double speed_max_m_s = 8.0;  // that the position loop asks for
  double tilt_max_rad = rad(40.0);
  double yaw_rate_max_rad_s = 3.5;
  double body_rate_max_rad_s = 4.0;
};

struct WindParams {
  Vec3 mean_enu_m_s = Vec3::Zero();
  double gust_m_s = 0.0;  // standard deviation on each horizontal axis
  double gust_time_s = 1.0;
};

struct QuadrotorState {
  VehicleState vehicle;
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  std::array<double, 4> thrusts_n{};  // front left, back right (+z torque), front right, back left
  Vec3 velocity_integral_m_s2 = Vec3::Zero();
  Vec3 gust_enu_m_s = Vec3::Zero();
  Random random{1};
};

/// Hovering at a place.
QuadrotorState make_quadrotor(const QuadrotorParams& params, const Vec3& position_enu_m,
                              double yaw_rad, std::uint64_t seed);

/// What the motors should do. Body FLU.
struct Wrench {
  double thrust_n = 0.0;
  Vec3 torque_n_m = Vec3::Zero();
};

/// The motors' steady thrusts for a wrench, each within its limits; their order as in the state.
std::array<double, 4> mix(const QuadrotorParams& params, const Wrench& wrench);

/// The cascade. NaN in a field of the setpoint: not controlled. Jerk is not used, as in PX4.
Wrench control(const QuadrotorParams& params, QuadrotorState& state, const Setpoint& setpoint,
               double dt_s);

/// Flies the setpoint (or, unarmed, falls to the ground) for dt_s, in steps of 2 ms at most.
/// Cost: about 1 µs a step.
void fly_setpoint(const QuadrotorParams& params, const WindParams& wind, QuadrotorState& state,
                  const Setpoint& setpoint, bool armed, double dt_s);

}  // namespace foretrack
