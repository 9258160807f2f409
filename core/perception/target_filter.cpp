// SPDX-License-Identifier: Apache-2.0
#include "core/perception/target_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "core/common/white_acceleration.hpp"

namespace foretrack {
namespace {

TargetEstimate started(const TorsoMeasurement& m, const PerceptionParams& params) {
  TargetEstimate e;
  e.started = true;
  e.stamp_s = e.accepted_s = m.stamp_s;
  e.mean.head<3>() = m.position_enu_m;
  e.covariance.setZero();
  e.covariance.topLeftCorner<3, 3>() = m.covariance_m2;
  const double speed = params.initial_speed_sigma_m_s;
  e.covariance.diagonal().tail<3>() << speed * speed, speed * speed, 0.04 * speed * speed;
  e.yaw_rad = m.yaw_rad;
  e.yaw_variance_rad2 = m.yaw_variance_rad2;
  e.verdict = FilterVerdict::kStarted;
  return e;
}

void correct_yaw(TargetEstimate& e, const TorsoMeasurement& m, const PerceptionParams& params) {
  if (!std::isfinite(m.yaw_rad)) return;
  const double innovation = wrap_angle(m.yaw_rad - e.yaw_rad);
  const bool flipped = std::abs(innovation) > params.yaw_gate_rad;
  e.yaw_gated_in_a_row = flipped ? e.yaw_gated_in_a_row + 1 : 0;
  if (!std::isfinite(e.yaw_rad) || e.yaw_gated_in_a_row >= params.reinitialise_after) {
    e.yaw_rad = wrap_angle(m.yaw_rad);
    e.yaw_variance_rad2 = m.yaw_variance_rad2;
    e.yaw_gated_in_a_row = 0;
    return;
  }
  if (flipped) return;
  const double gain = e.yaw_variance_rad2 / (e.yaw_variance_rad2 + m.yaw_variance_rad2);
  e.yaw_rad = wrap_angle(e.yaw_rad + gain * innovation);
  e.yaw_variance_rad2 *= 1.0 - gain;
}

// Innovations that keep pointing the same way are a manoeuvre; noise has no mean.
void weigh_innovation(TargetEstimate& e, const Vec2& innovation, const Mat2& covariance,
                      double dt_s, const PerceptionParams& params) {
  const double keep = std::exp(-dt_s / params.manoeuvre_memory_s);
  const Vec2 normalised = covariance.llt().matrixL().solve(innovation);
  e.manoeuvre = keep * e.manoeuvre + (1.0 - keep) * normalised;
}

double horizontal_density(const TargetEstimate& e, const PerceptionParams& params) {
  const double ratio = e.manoeuvre.norm() / params.manoeuvre_level;
  const double weight = std::clamp(ratio * ratio - 1.0, 0.0, 1.0);
  const double density = params.steady_density_m2_s3 +
                         weight * (params.manoeuvre_density_m2_s3 - params.steady_density_m2_s3);
  const bool doubt = e.gated_in_a_row > 0 && e.gated_doubtful;
  return doubt ? std::min(density, params.doubt_density_m2_s3) : density;
}

void correct_position(TargetEstimate& e, const TorsoMeasurement& m, const Mat3& inverse) {
  const Eigen::Matrix<double, 6, 3> gain = e.covariance.leftCols<3>() * inverse;
  e.mean += gain * (m.position_enu_m - e.mean.head<3>());
  // Joseph's form keeps it symmetric and positive.
  Mat6 keep = Mat6::Identity();
  keep.leftCols<3>() -= gain;
  e.covariance = (keep * e.covariance * keep.transpose()).eval();
  e.covariance += gain * m.covariance_m2 * gain.transpose();
  e.accepted_s = m.stamp_s;
  e.gated_in_a_row = 0;
}

}  // namespace

TargetEstimate predict_estimate(const TargetEstimate& estimate, double stamp_s,
                                const PerceptionParams& params) {
  TargetEstimate e = estimate;
  const double dt = stamp_s - estimate.stamp_s;
  const double keep = std::exp(-dt / params.vertical_damping_s);
  Mat6 transition = Mat6::Identity();
  transition.topRightCorner<3, 3>().diagonal() << dt, dt, params.vertical_damping_s * (1.0 - keep);
  transition(5, 5) = keep;
  e.stamp_s = stamp_s;
  e.mean = transition * estimate.mean;
  e.covariance = transition * estimate.covariance * transition.transpose();
  const double horizontal = horizontal_density(estimate, params);
  const Vec3 density(horizontal, horizontal, params.vertical_density_m2_s3);
  add_white_acceleration<3>(e.covariance, density, dt);
  e.yaw_variance_rad2 += params.yaw_density_rad2_s * dt;
  return e;
}

TargetEstimate advance(const TargetEstimate& estimate, const TorsoMeasurement& m,
                       const PerceptionParams& params) {
  if (!estimate.started || m.stamp_s - estimate.accepted_s > params.lost_age_s)
    return started(m, params);
  TargetEstimate e = predict_estimate(estimate, m.stamp_s, params);
  const Vec3 innovation = m.position_enu_m - e.mean.head<3>();
  const Mat3 spread = e.covariance.topLeftCorner<3, 3>() + m.covariance_m2;
  const Mat3 inverse = spread.inverse();
  e.mahalanobis = std::sqrt(std::max(0.0, innovation.dot(inverse * innovation)));
  if (e.mahalanobis <= params.gate_mahalanobis) {
    weigh_innovation(e, innovation.head<2>(), spread.topLeftCorner<2, 2>(),
                     m.stamp_s - estimate.stamp_s, params);
    correct_position(e, m, inverse);
    correct_yaw(e, m, params);
    e.verdict = FilterVerdict::kAccepted;
    return e;
  }
  const bool agrees = e.gated_in_a_row > 0 &&
                      (m.position_enu_m - e.gated_position_m).norm() < params.reinitialise_radius_m;
  e.gated_in_a_row = agrees ? e.gated_in_a_row + 1 : 1;
  e.gated_position_m = m.position_enu_m;
  e.gated_doubtful = m.doubtful;
  e.verdict = FilterVerdict::kGated;
  const int enough = m.doubtful ? params.reinitialise_doubtful_after : params.reinitialise_after;
  return e.gated_in_a_row >= enough ? started(m, params) : e;
}

TargetState target_state(const TargetEstimate& estimate) {
  TargetState target;
  target.stamp_s = estimate.stamp_s;
  target.position_enu_m = estimate.mean.head<3>();
  target.velocity_enu_m_s = estimate.mean.tail<3>();
  target.covariance = estimate.covariance;
  target.body_yaw_rad = estimate.yaw_rad;
  target.body_yaw_variance_rad2 = estimate.yaw_variance_rad2;
  target.last_measurement_s = estimate.accepted_s;
  return target;
}

}  // namespace foretrack
