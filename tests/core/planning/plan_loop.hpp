// SPDX-License-Identifier: Apache-2.0
// A walking target and an ideal vehicle that flies exactly what is planned: for tests and
// benchmarks of the planner alone.
#pragma once

#include "core/common/random.hpp"
#include "core/planning/plan.hpp"
#include "core/simulator/generate_world.hpp"

namespace foretrack::testing {

/// Walks straight legs with sharp turns between them, where the world leaves room.
class Walker {
 public:
  Walker(const World& world, const Vec2& position, double speed_m_s, std::uint64_t seed)
      : world_(world), random_(seed), position_(position), speed_m_s_(speed_m_s) {
    heading_rad_ = random_.uniform(-kPi, kPi);
    choose_leg();
  }

  void advance(double dt_s) {
    left_m_ -= speed_m_s_ * dt_s;
    if (left_m_ <= 0.0) choose_leg();
    // The velocity swings round within the target's acceleration.
    const Vec2 missing = speed_m_s_ * direction_of(heading_rad_) - velocity_;
    const double most = kAcceleration_m_s2 * dt_s;
    const Vec2 change = missing.norm() > most ? Vec2(missing.normalized() * most) : missing;
    velocity_ += change;
    const Vec2 next = position_ + dt_s * velocity_;
    if (ground_clearance_m(world_, next) > 0.25 && world_.contains(at(next))) {
      position_ = next;
    } else {
      velocity_.setZero();
      choose_leg();
    }
  }

  TargetState state(double now_s) const {
    TargetState target;
    target.stamp_s = target.last_measurement_s = now_s;
    target.status = TrackStatus::kTracking;
    target.position_enu_m = at(position_);
    target.velocity_enu_m_s << velocity_, 0.0;
    target.covariance = Mat6::Identity() * 0.01;
    target.body_yaw_rad = heading_rad_;
    target.body_yaw_variance_rad2 = 0.05;
    return target;
  }

  int turns() const { return turns_; }

 private:
  static constexpr double kAcceleration_m_s2 = 6.0;
  static constexpr double kHeight_m = 1.0;

  static Vec3 at(const Vec2& p) { return {p.x(), p.y(), kHeight_m}; }

  // The first random leg that is free; turns are sharp. Without one, the freest direction.
  void choose_leg() {
    ++turns_;
    double best_m = -1.0, best_rad = heading_rad_;
    for (int i = 0; i < 60; ++i) {
      const double turn_rad =
          random_.uniform(rad(50.0), rad(135.0)) * (random_.chance(0.5) ? 1 : -1);
      const double heading_rad = i < 40 ? heading_rad_ + turn_rad : random_.uniform(-kPi, kPi);
      const double wanted_m = random_.uniform(2.0, 5.0);
      const double free_m = free_way_m(heading_rad, wanted_m);
      if (free_m > best_m) best_m = free_m, best_rad = heading_rad;
      if (free_m >= wanted_m) break;
    }
    heading_rad_ = wrap_angle(best_rad);
    left_m_ = std::max(best_m - 0.2, 0.3);
  }

  double free_way_m(double heading_rad, double wanted_m) const {
    double way_m = 0.0;
    while (way_m < wanted_m) {
      const Vec2 p = position_ + (way_m + 0.2) * direction_of(heading_rad);
      if (!world_.contains(at(p)) || ground_clearance_m(world_, p) < 0.45) break;
      way_m += 0.2;
    }
    return way_m;
  }

  const World& world_;
  Random random_;
  Vec2 position_, velocity_ = Vec2::Zero();
  double speed_m_s_, heading_rad_ = 0.0, left_m_ = 0.0;
  int turns_ = 0;
};

/// The vehicle's state on a trajectory, level attitude.
inline VehicleState state_on(const PlannedTrajectory& trajectory, double now_s) {
  const double t = now_s - trajectory.start_s;
  VehicleState vehicle;
  vehicle.stamp_s = now_s;
  vehicle.position_enu_m = trajectory.position(t);
  vehicle.velocity_enu_m_s = trajectory.velocity(t);
  const AngleNode yaw = trajectory.yaw.at(t);
  vehicle.q_world_body = Quat(Eigen::AngleAxisd(yaw.angle_rad, Vec3::UnitZ()));
  vehicle.angular_velocity_body_rad_s = {0.0, 0.0, yaw.rate_rad_s};
  return vehicle;
}

inline VehicleState hovering(const Vec3& position_enu_m, double yaw_rad, double now_s) {
  VehicleState vehicle;
  vehicle.stamp_s = now_s;
  vehicle.position_enu_m = position_enu_m;
  vehicle.q_world_body = Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()));
  return vehicle;
}

}  // namespace foretrack::testing
