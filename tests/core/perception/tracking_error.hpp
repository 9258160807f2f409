// SPDX-License-Identifier: Apache-2.0
// Follows a synthetic person with perceive() and compares the estimate with the truth.
#pragma once

#include "core/perception/perceive.hpp"
#include "tests/core/perception/synthetic_person.hpp"

namespace foretrack::test {

struct FollowScene {
  Walk walk;
  LandmarkNoise noise;
  double range_m = 2.0;
  double rate_hz = 30.0;
};

/// Root mean squares from the first second on; "straight" is before the turn.
struct TrackingError {
  double position_m = 0.0, position_straight_m = 0.0;
  double velocity_m_s = 0.0, velocity_straight_m_s = 0.0;
  double yaw_rad = 0.0, yaw_straight_rad = 0.0;
  double velocity_lag_s = 0.0, yaw_lag_s = 0.0;  // by which the truth fits best around the turn
  double straight_nees = 0.0;                    // normalised error squared; 4 is expected
  double refused = 0.0;                          // share of measurements
};

class ErrorCollector {
 public:
  void add(double t_s, const Walk& walk, const TargetState& target) {
    const PersonState truth = walk.at(t_s);
    Eigen::Vector4d error;
    error << (target.position_enu_m - torso_of(truth)).head<2>(),
        (target.velocity_enu_m_s - truth.velocity_enu_m_s).head<2>();
    const double yaw = wrap_angle(target.body_yaw_rad - truth.yaw_rad);
    const Eigen::Vector3d squares(error.head<2>().squaredNorm(), error.tail<2>().squaredNorm(),
                                  yaw * yaw);
    all_ += squares;
    ++count_;
    if (t_s < walk.turn_s - walk.body_lead_s - 0.1) {
      straight_ += squares;
      nees_ += error.dot(horizontal(target.covariance).inverse() * error);
      ++straight_count_;
    } else if (t_s < walk.turn_s + 1.2) {
      for (int k = 0; k < kLags; ++k) add_lag(k, walk.at(t_s - kLagStep_s * k), target);
    }
  }
  TrackingError result() const {
    TrackingError e;
    e.position_m = std::sqrt(all_[0] / count_);
    e.velocity_m_s = std::sqrt(all_[1] / count_);
    e.yaw_rad = std::sqrt(all_[2] / count_);
    e.position_straight_m = std::sqrt(straight_[0] / straight_count_);
    e.velocity_straight_m_s = std::sqrt(straight_[1] / straight_count_);
    e.yaw_straight_rad = std::sqrt(straight_[2] / straight_count_);
    e.straight_nees = nees_ / straight_count_;
    e.velocity_lag_s = kLagStep_s * least(velocity_lags_);
    e.yaw_lag_s = kLagStep_s * least(yaw_lags_);
    return e;
  }

 private:
  static constexpr int kLags = 40;
  static constexpr double kLagStep_s = 0.01;
  using Lags = std::array<double, kLags>;

  static Eigen::Matrix4d horizontal(const Mat6& covariance) {
    const Eigen::Array4i kept(0, 1, 3, 4);
    return covariance(kept, kept);
  }
  static int least(const Lags& lags) {
    return static_cast<int>(std::min_element(lags.begin(), lags.end()) - lags.begin());
  }
  void add_lag(int k, const PersonState& then, const TargetState& target) {
    const double yaw = wrap_angle(target.body_yaw_rad - then.yaw_rad);
    yaw_lags_[k] += yaw * yaw;
    velocity_lags_[k] += (target.velocity_enu_m_s - then.velocity_enu_m_s).head<2>().squaredNorm();
  }

  Eigen::Vector3d all_ = Eigen::Vector3d::Zero(), straight_ = Eigen::Vector3d::Zero();
  double nees_ = 0.0;
  int count_ = 0, straight_count_ = 0;
  Lags velocity_lags_{}, yaw_lags_{};
};

/// The vehicle keeps its range behind the person and swings around with a time constant of 0.8 s.
inline TrackingError follow(int runs, const FollowScene& scene = {},
                            const PerceptionParams& params = {}) {
  ErrorCollector collector;
  int refused = 0, total = 0;
  for (int run = 0; run < runs; ++run) {
    Walk walk = scene.walk;
    if (run % 2) walk.turn_rad = -walk.turn_rad;
    Random random(static_cast<std::uint64_t>(run) + 1);
    PerceptionState state;
    VehicleHistory history;
    double bearing = 0.0;
    for (int k = 0; k < 6.0 * scene.rate_hz; ++k, ++total) {
      const double t = k / scene.rate_hz;
      const PersonState person = walk.at(t);
      bearing += wrap_angle(walk.heading(t) - bearing) / (0.8 * scene.rate_hz);
      Vec3 place = torso_of(person);
      place.head<2>() -= scene.range_m * direction_of(bearing);
      place.z() = 1.4;
      const VehicleState vehicle = vehicle_at(t, place, torso_of(person));
      history.add(vehicle);
      const auto result =
          perceive(state, observe(person, vehicle, scene.noise, random), history, params);
      refused += result.status != PerceptionStatus::kAccepted && k > 0;
      if (t >= 1.0) collector.add(t, walk, result.target);
    }
  }
  TrackingError error = collector.result();
  error.refused = static_cast<double>(refused) / total;
  return error;
}

}  // namespace foretrack::test
