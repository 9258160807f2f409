// SPDX-License-Identifier: Apache-2.0
// The Kalman filter of the target: position and velocity of the torso, and beside them the body's
// yaw.
#pragma once

#include <limits>

#include "core/common/geometry.hpp"
#include "core/common/target.hpp"
#include "core/perception/params.hpp"

namespace foretrack {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The torso's centre as it was measured once, world ENU.
struct TorsoMeasurement {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Mat3 covariance_m2 = Mat3::Identity();                      ///< of the position
  double yaw_rad = std::numeric_limits<double>::quiet_NaN();  ///< of the chest; NaN: not measured
  double yaw_variance_rad2 = 1.0;
  bool doubtful = false;  ///< it may be somebody else's
};

/// What the filter did with a measurement.
enum class FilterVerdict : std::uint8_t {
  kAccepted,  ///< the estimate was corrected by it
  kGated,     ///< it is too far away; the estimate was only predicted
  kStarted,   ///< the estimate starts (anew) from it
};

/// What is believed after a measurement. It is a value, so that filtering can begin again from an
/// older one.
struct TargetEstimate {
  bool started = false;  ///< false: nothing has been measured yet
  double stamp_s = 0.0;
  Vec6 mean = Vec6::Zero();                                   ///< position, velocity; world ENU, SI
  Mat6 covariance = Mat6::Identity();                         ///< of the mean
  double yaw_rad = std::numeric_limits<double>::quiet_NaN();  ///< of the chest; NaN: not known
  double yaw_variance_rad2 = 1.0;
  double accepted_s = 0.0;  ///< stamp of the last accepted measurement
  /// Mean of the last innovations, in standard deviations: far from zero while the target turns,
  /// stops or starts.
  Vec2 manoeuvre = Vec2::Zero();
  int gated_in_a_row = 0;                ///< refused measurements that agree with each other
  bool gated_doubtful = false;           ///< the last of them may be somebody else's
  Vec3 gated_position_m = Vec3::Zero();  ///< where the last of them was
  int yaw_gated_in_a_row = 0;            ///< refused yaws
  FilterVerdict verdict = FilterVerdict::kStarted;  ///< on the last measurement
  double mahalanobis = 0.0;  ///< distance of the last measurement; 0 where the track started
};

/// The estimate at a later time, stamp_s ≥ estimate.stamp_s. The horizontal velocity stays; the
/// vertical speed is forgotten with the time constant vertical_damping_s. Process noise is white
/// acceleration (Bar-Shalom, Li and Kirubarajan 2001, §6.2), more of it in a manoeuvre. Cost: two
/// products of 6 × 6 matrices.
TargetEstimate predict_estimate(const TargetEstimate& estimate, double stamp_s,
                                const PerceptionParams& params);

/// Predicts to the measurement's stamp, then gates and corrects. A measurement whose Mahalanobis
/// distance is above gate_mahalanobis is refused. The track starts with the first measurement, with
/// the first one after a loss (lost_age_s), and where several refused measurements in a row agree
/// (reinitialise_after of them; more, if they are doubtful).
TargetEstimate advance(const TargetEstimate& estimate, const TorsoMeasurement& measurement,
                       const PerceptionParams& params);

/// The estimate as the other stages read it. The status is left to the caller.
TargetState target_state(const TargetEstimate& estimate);

}  // namespace foretrack
