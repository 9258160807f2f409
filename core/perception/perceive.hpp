// SPDX-License-Identifier: Apache-2.0
// Target observations → the target's estimated state (paper §III.A).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/common/target.hpp"
#include "core/common/vehicle.hpp"
#include "core/perception/params.hpp"
#include "core/perception/target_filter.hpp"

namespace foretrack {

/// What became of an observation.
enum class PerceptionStatus : std::uint8_t {
  kAccepted,         ///< the filter took it
  kStarted,          ///< taken, and the track starts (anew) here
  kGated,            ///< too far from where the target can be; not used
  kTooFewLandmarks,  ///< fewer than min_landmarks are visible
  kPnpFailed,        ///< no pose that enough landmarks agree with
  kNoVehiclePose,    ///< the vehicle's history does not reach the image's stamp
  kTooOld,           ///< it comes later than the reorder limit allows
  kDuplicate,        ///< of a stamp that was already used
  kInvalid,          ///< not finite, or its covariance is none
};
/// For logs and displays.
std::string_view to_string(PerceptionStatus status);

/// What is kept from observation to observation: the last measurements and the estimate after each.
/// A measurement that comes late is put in at its place, and those after it are filtered again. A
/// plain value that the caller owns.
struct PerceptionState {
  /// A measurement, and what was believed right after it.
  struct Entry {
    TorsoMeasurement measurement;
    TargetEstimate estimate;
  };
  static constexpr int kCapacity = 32;
  std::array<Entry, kCapacity> entries;  ///< the oldest first
  int count = 0;                         ///< the first of `entries` that are valid
};

/// What one observation gave.
struct PerceptionResult {
  PerceptionStatus status = PerceptionStatus::kInvalid;
  TargetState target;                ///< at the newest measurement, whatever the status
  TorsoMeasurement measured;         ///< valid if accepted, started or gated
  int used_landmarks = 0;            ///< that agree with the pose
  double reprojection_rms_px = 0.0;  ///< of those landmarks
  double mahalanobis = 0.0;          ///< how far the measurement was from the estimate
};

/// Takes one observation into the estimate. Landmarks give the pose of the body in the camera; the
/// vehicle's pose at the image's stamp puts its torso into the world; a Kalman filter takes it from
/// there. A position is filtered as it is. Observations may come late by reorder_limit_s: the
/// result is the same as if they had come in order.
///
/// `torso_depth_m` corrects the range that landmarks give. It is the depth of the torso's surface
/// along the optical axis, from a depth image of the same instant (torso_surface_depth_m()). NaN:
/// there is none.
///
/// Never throws; what is wrong with an observation is its status. Cost: about 40 µs, and 2 µs for
/// each measurement that is newer than a late one. Allocates nothing. Source: paper §III.A; the
/// filter's manoeuvres and late observations are ours.
PerceptionResult perceive(PerceptionState& state, const TargetObservation& observation,
                          const VehicleHistory& vehicle, const PerceptionParams& params,
                          double torso_depth_m = std::numeric_limits<double>::quiet_NaN());

/// Where an observation puts the torso, without a word of whose it is. None: see perceive().
std::optional<TorsoMeasurement> measure_torso(const TargetObservation& observation,
                                              const VehicleHistory& vehicle,
                                              const PerceptionParams& params);

/// The track begins anew at somebody else, whose motion is known.
void start_at(PerceptionState& state, const TargetState& target);

/// Tracking, coasting or lost at now_s, by the age of the last accepted measurement. A time before
/// the newest measurement counts as its time.
TrackStatus track_status(const PerceptionState& state, double now_s,
                         const PerceptionParams& params);

/// The estimate at now_s. The longer nothing was accepted, the greater is its covariance, and the
/// status goes from tracking to coasting to lost. A time before the newest measurement counts as
/// its time. Cost: below 1 µs.
TargetState coast(const PerceptionState& state, double now_s, const PerceptionParams& params);

}  // namespace foretrack
