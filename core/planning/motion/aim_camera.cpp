// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/aim_camera.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kNear_m = 0.2;  // nearer than this, a bearing means nothing

// Sum of unit vectors towards the target, weighted by probability: x, y in the plane, z up.
Vec3 mean_direction(const Vec3& from, const ExpectedTarget& expected, double t_s) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < expected.count; ++i) {
    const Vec3 offset = expected.paths[i].position(t_s) - from;
    const double distance_m = offset.head<2>().norm();
    if (distance_m > kNear_m) sum += expected.paths[i].probability / distance_m * offset;
  }
  return sum;
}

// From where the plan begins to where the target then is: one direction for the whole plan.
Vec3 present_direction(const PlanStart& start, const ExpectedTarget& expected, double step_s) {
  const ExpectedPath& path = expected.paths[0];
  return path.positions_enu_m.front() - step_s * path.velocities_enu_m_s.front() -
         start.state.position;
}

// A vehicle that turns swings over what is planned.
AngleLimits yaw_limits(const PlanningParams& p) {
  return {kPlannedShare * p.limits.yaw_rate_max_rad_s, p.limits.yaw_acceleration_max_rad_s2,
          0.5 * p.view.fov_horizontal_rad - p.view.fov_margin_rad, p.view.yaw_effort};
}
AngleLimits gimbal_limits(const PlanningParams& p) {
  return {p.view.gimbal_rate_max_rad_s, p.view.gimbal_acceleration_max_rad_s2, kPi,
          p.view.yaw_effort};
}

void plan_angles(const PlanStart& start, const PlanningParams& params, AimWorkspace& w,
                 PlannedTrajectory& trajectory) {
  plan_angle(start.yaw, w.yaws_rad, yaw_limits(params), w.angles, trajectory.yaw);
  trajectory.gimbal_pitch.nodes.clear();
  if (params.view.gimbal)
    plan_angle(start.gimbal_pitch, w.pitches_rad, gimbal_limits(params), w.angles,
               trajectory.gimbal_pitch);
}

}  // namespace

void aim_camera(const PlanStart& start, const ExpectedTarget& expected,
                const PlanningParams& params, AimWorkspace& w, PlannedTrajectory& trajectory) {
  w.yaws_rad.clear();
  w.pitches_rad.clear();
  const double dt_s = trajectory.yaw.dt_s;
  const int nodes = static_cast<int>(std::ceil(trajectory.duration_s() / dt_s));
  double yaw_rad = start.yaw.angle_rad, pitch_rad = start.gimbal_pitch.angle_rad;
  for (int i = 1; i <= nodes; ++i) {
    const double t_s = i * dt_s;
    const Vec3 direction = params.view.yaw_ahead
                               ? mean_direction(trajectory.position(t_s), expected, t_s)
                               : present_direction(start, expected, params.horizon.step_s);
    const double along = direction.head<2>().norm();
    if (along > 0.1) {
      yaw_rad = yaw_of(Vec2(direction.head<2>()));
      pitch_rad = std::atan2(direction.z(), along);
    }
    w.yaws_rad.push_back(yaw_rad);
    w.pitches_rad.push_back(pitch_rad);
  }
  plan_angles(start, params, w, trajectory);
}

void hold_camera(const PlanStart& start, const PlanningParams& params, AimWorkspace& w,
                 PlannedTrajectory& trajectory) {
  w.yaws_rad.clear();
  w.pitches_rad.clear();
  plan_angles(start, params, w, trajectory);
}

}  // namespace foretrack
