// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/quadrotor.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kStep_s = 0.002;

Vec3 limited(const Vec3& v, double norm_max) {
  const double norm = v.norm();
  return norm > norm_max ? Vec3(v * (norm_max / norm)) : v;
}

// a, or the fallback where a is NaN.
Vec3 controlled(const Vec3& a, const Vec3& fallback) {
  return a.array().isNaN().select(fallback, a);
}

// Position and velocity loops (NaN: that loop asks for nothing on that axis).
Vec3 wanted_acceleration(const QuadrotorParams& p, QuadrotorState& state, const Setpoint& setpoint,
                         double dt_s) {
  const VehicleState& v = state.vehicle;
  const Vec3 position_error =
      controlled(setpoint.position_enu_m, v.position_enu_m) - v.position_enu_m;
  const Eigen::Array3d moves =
      (setpoint.position_enu_m.array().isNaN() && setpoint.velocity_enu_m_s.array().isNaN())
          .select(Eigen::Array3d::Zero(), 1.0);
  const Vec3 velocity = limited(
      p.position_gain * position_error + controlled(setpoint.velocity_enu_m_s, Vec3::Zero()),
      p.speed_max_m_s);
  const Vec3 error = moves * (velocity - v.velocity_enu_m_s).array();
  state.velocity_integral_m_s2 =
      limited(state.velocity_integral_m_s2 + p.velocity_integral_gain * dt_s * error, 3.0);
  return controlled(setpoint.acceleration_enu_m_s2, Vec3::Zero()) + p.velocity_gain * error +
         state.velocity_integral_m_s2;
}

// Height has precedence: the horizontal force gives way to the tilt limit.
Vec3 wanted_force(const QuadrotorParams& p, const Vec3& acceleration) {
  Vec3 force = p.mass_kg * (acceleration + kGravity_m_s2 * Vec3::UnitZ());
  const double greatest = 0.9 * 4.0 * p.motor_thrust_max_n;
  force.z() = std::clamp(force.z(), 0.2 * p.mass_kg * kGravity_m_s2, greatest);
  const double sideways_max = force.z() * std::tan(p.tilt_max_rad);
  const double sideways = force.head<2>().norm();
  if (sideways > sideways_max) force.head<2>() *= sideways_max / sideways;
  return limited(force, greatest);
}

// Attitude whose z axis is along the force and whose heading is the yaw.
Mat3 wanted_attitude(const Vec3& force, double yaw_rad) {
  const Vec2 heading = direction_of(yaw_rad);
  Mat3 r;
  r.col(2) = force.normalized();
  r.col(1) = r.col(2).cross(Vec3(heading.x(), heading.y(), 0.0)).normalized();
  r.col(0) = r.col(1).cross(r.col(2));
  return r;
}

// Body rates that close the attitude error on SO(3) (Lee et al. 2010), yaw slower than tilt.
Vec3 wanted_rates(const QuadrotorParams& p, const Mat3& r, const Mat3& r_wanted,
                  double yaw_rate_rad_s) {
  const Mat3 e = 0.5 * (r_wanted.transpose() * r - r.transpose() * r_wanted);
  const Vec3 error(e(2, 1), e(0, 2), e(1, 0));
  Vec3 rates = -Vec3(p.attitude_gain, p.attitude_gain, p.yaw_gain).cwiseProduct(error);
  rates += yaw_rate_rad_s * r.transpose().col(2);  // about the world's z axis
  rates.z() = std::clamp(rates.z(), -p.yaw_rate_max_rad_s, p.yaw_rate_max_rad_s);
  rates.head<2>() =
      rates.head<2>().cwiseMax(-p.body_rate_max_rad_s).cwiseMin(p.body_rate_max_rad_s);
  return rates;
}

// What the four thrusts do together; the inverse of mix within the limits.
Wrench wrench_of(const QuadrotorParams& p, const std::array<double, 4>& f) {
  return {f[0] + f[1] + f[2] + f[3],
          {p.arm_m * (f[0] - f[1] - f[2] + f[3]), p.arm_m * (-f[0] + f[1] - f[2] + f[3]),
           p.torque_per_thrust_m * (f[0] + f[1] - f[2] - f[3])}};
}

void blow(const WindParams& wind, QuadrotorState& state, double dt_s) {
  if (wind.gust_m_s <= 0.0) return;
  const double keep = std::exp(-dt_s / wind.gust_time_s);
  const double fresh = wind.gust_m_s * std::sqrt(1.0 - keep * keep);
  for (int axis = 0; axis < 2; ++axis)
    state.gust_enu_m_s[axis] = keep * state.gust_enu_m_s[axis] + fresh * state.random.normal();
}

void integrate(const QuadrotorParams& p, const WindParams& wind, QuadrotorState& state,
               double dt_s) {
  VehicleState& v = state.vehicle;
  const Wrench wrench = wrench_of(p, state.thrusts_n);
  const Vec3 airspeed = v.velocity_enu_m_s - wind.mean_enu_m_s - state.gust_enu_m_s;
  state.acceleration_enu_m_s2 =
      (v.q_world_body * Vec3(0.0, 0.0, wrench.thrust_n) - p.drag_n_s_m * airspeed) / p.mass_kg -
      kGravity_m_s2 * Vec3::UnitZ();
  Vec3& w = v.angular_velocity_body_rad_s;
  const Vec3 momentum = p.inertia_kg_m2.cwiseProduct(w);
  w += dt_s * (wrench.torque_n_m - w.cross(momentum)).cwiseQuotient(p.inertia_kg_m2);
  v.position_enu_m += dt_s * v.velocity_enu_m_s + 0.5 * dt_s * dt_s * state.acceleration_enu_m_s2;
  v.velocity_enu_m_s += dt_s * state.acceleration_enu_m_s2;
  const double angle = w.norm() * dt_s;
  if (angle > 1e-12)
    v.q_world_body = (v.q_world_body * Quat(Eigen::AngleAxisd(angle, w.normalized()))).normalized();
  v.stamp_s += dt_s;
}

void rest_on_ground(QuadrotorState& state) {
  VehicleState& v = state.vehicle;
  if (v.position_enu_m.z() > 0.0) return;
  v.position_enu_m.z() = 0.0;
  v.velocity_enu_m_s.setZero();
  v.angular_velocity_body_rad_s.setZero();
  v.q_world_body = Quat(Eigen::AngleAxisd(v.yaw_rad(), Vec3::UnitZ()));
}

}  // namespace

QuadrotorState make_quadrotor(const QuadrotorParams& params, const Vec3& position_enu_m,
                              double yaw_rad, std::uint64_t seed) {
  QuadrotorState state;
  state.vehicle.position_enu_m = position_enu_m;
  state.vehicle.q_world_body = Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()));
  state.thrusts_n.fill(0.25 * params.mass_kg * kGravity_m_s2);
  state.random = Random(seed);
  return state;
}

std::array<double, 4> mix(const QuadrotorParams& p, const Wrench& wrench) {
  const double t = 0.25 * wrench.thrust_n;
  const double x = 0.25 * wrench.torque_n_m.x() / p.arm_m;
  const double y = 0.25 * wrench.torque_n_m.y() / p.arm_m;
  // Yaw gets what tilt leaves over.
  const double room =
      std::max(0.0, std::min(t, p.motor_thrust_max_n - t) - std::abs(x) - std::abs(y));
  const double z = std::clamp(0.25 * wrench.torque_n_m.z() / p.torque_per_thrust_m, -room, room);
  std::array<double, 4> f = {t + x - y + z, t - x + y + z, t - x - y - z, t + x + y - z};
  for (double& thrust : f) thrust = std::clamp(thrust, 0.0, p.motor_thrust_max_n);
  return f;
}

Wrench control(const QuadrotorParams& p, QuadrotorState& state, const Setpoint& setpoint,
               double dt_s) {
  const VehicleState& v = state.vehicle;
  const Vec3 force = wanted_force(p, wanted_acceleration(p, state, setpoint, dt_s));
  const double yaw = std::isnan(setpoint.yaw_rad) ? v.yaw_rad() : setpoint.yaw_rad;
  const double yaw_rate = std::isnan(setpoint.yaw_rate_rad_s) ? 0.0 : setpoint.yaw_rate_rad_s;
  const Mat3 r = v.q_world_body.toRotationMatrix();
  const Vec3 rates = wanted_rates(p, r, wanted_attitude(force, yaw), yaw_rate);
  const Vec3& w = v.angular_velocity_body_rad_s;
  Wrench wrench;
  wrench.thrust_n = std::max(0.0, force.dot(r.col(2)));
  wrench.torque_n_m = p.inertia_kg_m2.cwiseProduct(p.rate_gain * (rates - w)) +
                      w.cross(p.inertia_kg_m2.cwiseProduct(w));
  return wrench;
}

void fly_setpoint(const QuadrotorParams& params, const WindParams& wind, QuadrotorState& state,
                  const Setpoint& setpoint, bool armed, double dt_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kStep_s - 1e-9)));
  const double step_s = dt_s / steps;
  const double follow = 1.0 - std::exp(-step_s / params.motor_lag_s);
  for (int i = 0; i < steps; ++i) {
    blow(wind, state, step_s);
    std::array<double, 4> wanted{};
    if (armed) wanted = mix(params, control(params, state, setpoint, step_s));
    for (int m = 0; m < 4; ++m) state.thrusts_n[m] += follow * (wanted[m] - state.thrusts_n[m]);
    integrate(params, wind, state, step_s);
    rest_on_ground(state);
  }
}

}  // namespace foretrack
