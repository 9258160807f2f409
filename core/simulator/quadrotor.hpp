// SPDX-License-Identifier: Apache-2.0
// A quadrotor as a rigid body: four lagging motors, drag in the wind, and the cascade of a flight
// controller that flies setpoints.
#pragma once

#include <array>

#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"

namespace foretrack {

/// A quadrotor of 1 kg and its flight controller.
struct QuadrotorParams {
  double mass_kg = 1.0;
  Vec3 inertia_kg_m2 = Vec3(0.008, 0.008, 0.014);
  double arm_m = 0.12;                 ///< of each motor from the axes, forward and sideways
  double torque_per_thrust_m = 0.016;  ///< about the motor's axis, by the propeller's drag
  double motor_lag_s = 0.03;           ///< time constant in which the thrust follows
  double motor_thrust_max_n = 6.0;     ///< of each motor
  double drag_n_s_m = 0.20;            ///< linear in the speed through the air
  // Cascade: position → velocity → acceleration → attitude → body rates; gains are in 1/s.
  double position_gain = 1.5;
  double velocity_gain = 3.0;
  double velocity_integral_gain = 0.6;
  double attitude_gain = 7.0;
  double yaw_gain = 3.0;
  double rate_gain = 20.0;
  double speed_max_m_s = 8.0;  ///< that the position loop asks for
  double tilt_max_rad = rad(40.0);
  double yaw_rate_max_rad_s = 3.5;
  double body_rate_max_rad_s = 4.0;
};

/// A steady wind, and gusts (a Gauss–Markov process of first order on each horizontal axis).
struct WindParams {
  Vec3 mean_enu_m_s = Vec3::Zero();
  double gust_m_s = 0.0;     ///< standard deviation
  double gust_time_s = 1.0;  ///< time constant in which a gust dies down
};

/// The vehicle with all that changes in flight.
struct QuadrotorState {
  VehicleState vehicle;
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  /// Front left and back right (torque about +z), front right and back left (about −z).
  std::array<double, 4> thrusts_n{};
  Vec3 velocity_integral_m_s2 = Vec3::Zero();  ///< of the velocity loop
  Vec3 gust_enu_m_s = Vec3::Zero();
  Random random{1};
};

/// A vehicle that hovers at a place.
QuadrotorState make_quadrotor(const QuadrotorParams& params, const Vec3& position_enu_m,
                              double yaw_rad, std::uint64_t seed);

/// What the motors should do. Body FLU.
struct Wrench {
  double thrust_n = 0.0;
  Vec3 torque_n_m = Vec3::Zero();
};

/// The motors' steady thrusts for a wrench, each within its limits, in the order of the state.
/// Where they cannot do it all, thrust and tilt go before yaw.
std::array<double, 4> mix(const QuadrotorParams& params, const Wrench& wrench);

/// The wrench that the flight controller wants for a setpoint: a cascade of loops with the attitude
/// on SO(3) (Lee, Leok and McClamroch 2010). NaN in a field of the setpoint: not controlled. Jerk
/// is not used, as in PX4.
Wrench control(const QuadrotorParams& params, QuadrotorState& state, const Setpoint& setpoint,
               double dt_s);

/// Flies the setpoint (or, unarmed, falls to the ground) for dt_s, in steps of 2 ms at most.
/// Cost: about 1 µs a step.
void fly_setpoint(const QuadrotorParams& params, const WindParams& wind, QuadrotorState& state,
                  const Setpoint& setpoint, bool armed, double dt_s);

}  // namespace foretrack
