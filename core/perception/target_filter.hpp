// SPDX-License-Identifier: Apache-2.0
// The Kalman filter of the target: position, velocity and body yaw.
#pragma once

#include <limits>

#include "core/common/geometry.hpp"
#include "core/common/target.hpp"
#include "core/perception/params.hpp"

namespace foretrack {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The torso as it was measured once, in the world.
struct TorsoMeasurement {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Mat3 covariance_m2 = Mat3::Identity();
  double yaw_rad = std::numeric_limits<double>::quiet_NaN();  // NaN: not measured
  double yaw_variance_rad2 = 1.0;
  bool doubtful = false;  // it may be somebody else's
};

enum class FilterVerdict : std::uint8_t { kAccepted, kGated, kStarted };

/// What is believed after a measurement. A value: refiltering starts from an older one.
struct TargetEstimate {
  bool started = false;
  double stamp_s = 0.0;
  Vec6 mean = Vec6::Zero();  // position, velocity; world ENU
  Mat6 covariance = Mat6::Identity();
  double yaw_rad = std::numeric_limits<double>::quiet_NaN();
  double yaw_variance_rad2 = 1.0;
  double accepted_s = 0.0;        // stamp of the last accepted measurement
  Vec2 manoeuvre = Vec2::Zero();  // mean of the recent innovations, in standard deviations
  int gated_in_a_row = 0;
  bool gated_doubtful = false;           // the last of them may have been somebody else
  Vec3 gated_position_m = Vec3::Zero();  // the last of them
  int yaw_gated_in_a_row = 0;
  FilterVerdict verdict = FilterVerdict::kStarted;  // on the last measurement
  double mahalanobis = 0.0;                         // of the last measurement; 0 at the start
};

/// The estimate at stamp_s ≥ estimate.stamp_s: constant horizontal velocity, damped vertical speed,
/// white acceleration as process noise, more of it in a manoeuvre. Cost: two 6 × 6 products.
TargetEstimate predict_estimate(const TargetEstimate& estimate, double stamp_s,
                                const PerceptionParams& params);

/// Predict, gate, correct. Starts the track on the first measurement, after a loss, and after
/// several agreeing measurements that the gate refused; more of them where they are doubtful.
TargetEstimate advance(const TargetEstimate& estimate, const TorsoMeasurement& measurement,
                       const PerceptionParams& params);

/// As the other stages read it; the status is left to the caller.
TargetState target_state(const TargetEstimate& estimate);

}  // namespace foretrack
