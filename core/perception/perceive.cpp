// SPDX-License-Identifier: Apache-2.0
#include "core/perception/perceive.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/perception/body_pose.hpp"

namespace foretrack {
namespace {

constexpr double kSameStamp_s = 1e-6;
constexpr double kLeastVariance_m2 = 1e-6;  // so that a source may call itself exact

// Two shoulders in the world → where the chest points. The paper's normal points to the back in a
// z-up frame; this is its negative.
double yaw_from_shoulders(const Vec3& left, const Vec3& right) {
  return std::atan2(right.x() - left.x(), left.y() - right.y());
}

// Across the line of sight the noise is that of the joints; along it it grows with the range,
// because range comes from apparent size, unless a depth image gave it.
Mat3 position_noise(const Vec3& sight_m, bool by_depth, const PerceptionParams& params) {
  const double along_m =
      by_depth ? params.depth_noise_m : params.range_noise_ratio * sight_m.norm();
  const Vec3 direction = sight_m.normalized();
  return Mat3::Identity() * params.lateral_noise_m * params.lateral_noise_m +
         along_m * along_m * direction * direction.transpose();
}

// How many times farther than the landmarks say a depth image puts the torso; 0: not to be
// believed, or there is none (NaN).
double depth_correction(const Vec3& torso_camera_m, double surface_m,
                        const PerceptionParams& params) {
  const double ratio = (surface_m + params.torso_half_depth_m) / torso_camera_m.z();
  return std::abs(ratio - 1.0) <= params.depth_agreement_ratio ? ratio : 0.0;
}

bool measure_landmarks(const TargetObservation& observation, const VehicleHistory& vehicle,
                       double torso_depth_m, const PerceptionParams& params,
                       PerceptionResult& result) {
  const auto refuse = [&](PerceptionStatus status) { return result.status = status, false; };
  if (visible_count(observation.landmarks, params) < params.min_landmarks)
    return refuse(PerceptionStatus::kTooFewLandmarks);
  const auto at_image = vehicle.at(observation.stamp_s);
  if (!at_image) return refuse(PerceptionStatus::kNoVehiclePose);
  const auto body = estimate_body_pose(observation.landmarks, observation.camera, params);
  if (!body) return refuse(PerceptionStatus::kPnpFailed);

  const Pose T_world_camera = at_image->T_world_body() * observation.camera.T_body_camera;
  Vec3 torso_m = torso_camera_m(*body, observation.landmarks, params);
  const double farther = depth_correction(torso_m, torso_depth_m, params);
  if (farther > 0.0) torso_m *= farther;
  TorsoMeasurement& m = result.measured;
  m.position_enu_m = T_world_camera * torso_m;
  const double noise = body->noise_scale * body->noise_scale;
  const Mat3 to_world = T_world_camera.linear();
  const Vec3 sight_m = to_world * torso_m;
  m.covariance_m2 = noise * position_noise(sight_m, farther > 0.0, params) +
                    to_world * body->cut_off_covariance_m2 * to_world.transpose();
  const auto seen_m = [&](TorsoJoint joint) -> Vec3 {
    return T_world_camera *
           seen_joint_m(*body, observation.landmarks[joint], observation.camera, params);
  };
  if (body->used[kLeftShoulder] && body->used[kRightShoulder])
    m.yaw_rad = yaw_from_shoulders(seen_m(kLeftShoulder), seen_m(kRightShoulder));
  m.yaw_variance_rad2 = noise * params.yaw_noise_rad * params.yaw_noise_rad;
  result.used_landmarks = body->used_count;
  result.reprojection_rms_px = body->reprojection_rms_px;
  return true;
}

bool measure_position(const TargetObservation& observation, PerceptionResult& result) {
  TorsoMeasurement& m = result.measured;
  m.position_enu_m = observation.position_enu_m;
  m.covariance_m2 = observation.covariance_m2 + kLeastVariance_m2 * Mat3::Identity();
  m.yaw_rad = observation.body_yaw_rad;
  m.yaw_variance_rad2 = observation.body_yaw_variance_rad2;
  return true;
}

bool is_valid(const TorsoMeasurement& m) {
  if (!std::isfinite(m.stamp_s)) return false;
  if (!m.position_enu_m.allFinite() || !m.covariance_m2.allFinite()) return false;
  if (std::isfinite(m.yaw_rad) && !(m.yaw_variance_rad2 > 0.0)) return false;
  const Eigen::LLT<Mat3> factor(m.covariance_m2);
  return factor.info() == Eigen::Success;
}

TargetEstimate estimate_before(const PerceptionState& state, int index) {
  return index > 0 ? state.entries[index - 1].estimate : TargetEstimate{};
}

// Puts the measurement at its place in time; returns its index, or −1 with the reason in `status`.
int insert(PerceptionState& state, const TorsoMeasurement& m, const PerceptionParams& params,
           PerceptionStatus& status) {
  int index = state.count;
  while (index > 0 && state.entries[index - 1].measurement.stamp_s > m.stamp_s) --index;
  for (int k = std::max(0, index - 1); k < std::min(state.count, index + 1); ++k)
    if (std::abs(state.entries[k].measurement.stamp_s - m.stamp_s) < kSameStamp_s)
      return status = PerceptionStatus::kDuplicate, -1;
  const bool is_late = index < state.count;
  const double lateness_s =
      is_late ? state.entries[state.count - 1].measurement.stamp_s - m.stamp_s : 0.0;
  // Nothing is known from before the oldest entry, so a late one cannot be filtered in there.
  if (is_late && (index == 0 || lateness_s > params.reorder_limit_s))
    return status = PerceptionStatus::kTooOld, -1;
  auto* first = state.entries.data();
  if (state.count == PerceptionState::kCapacity) {
    std::move(first + 1, first + index, first);
    --index;
  } else {
    std::move_backward(first + index, first + state.count, first + state.count + 1);
    ++state.count;
  }
  state.entries[index].measurement = m;
  return index;
}

PerceptionStatus status_of(FilterVerdict verdict) {
  switch (verdict) {
    case FilterVerdict::kAccepted:
      return PerceptionStatus::kAccepted;
    case FilterVerdict::kStarted:
      return PerceptionStatus::kStarted;
    case FilterVerdict::kGated:
      break;
  }
  return PerceptionStatus::kGated;
}

void filter(PerceptionState& state, const PerceptionParams& params, PerceptionResult& result) {
  const int index = insert(state, result.measured, params, result.status);
  if (index < 0) return;
  for (int k = index; k < state.count; ++k)
    state.entries[k].estimate =
        advance(estimate_before(state, k), state.entries[k].measurement, params);
  result.status = status_of(state.entries[index].estimate.verdict);
  result.mahalanobis = state.entries[index].estimate.mahalanobis;
}

}  // namespace

std::string_view to_string(PerceptionStatus status) {
  constexpr std::array<std::string_view, 9> names = {"accepted",
                                                     "started",
                                                     "gated",
                                                     "too few landmarks",
                                                     "no pose of the body",
                                                     "no pose of the vehicle",
                                                     "too old",
                                                     "duplicate",
                                                     "invalid"};
  return names.at(static_cast<std::size_t>(status));
}

PerceptionResult perceive(PerceptionState& state, const TargetObservation& observation,
                          const VehicleHistory& vehicle, const PerceptionParams& params,
                          double torso_depth_m) {
  PerceptionResult result;
  result.measured.stamp_s = observation.stamp_s;
  result.measured.doubtful = observation.doubtful;
  const bool measured = observation.kind == TargetObservation::Kind::kLandmarks
                            ? measure_landmarks(observation, vehicle, torso_depth_m, params, result)
                            : measure_position(observation, result);
  if (measured && is_valid(result.measured)) filter(state, params, result);
  const double newest_s = state.count > 0 ? state.entries[state.count - 1].estimate.stamp_s : 0.0;
  result.target = coast(state, newest_s, params);
  return result;
}

std::optional<TorsoMeasurement> measure_torso(const TargetObservation& observation,
                                              const VehicleHistory& vehicle,
                                              const PerceptionParams& params) {
  constexpr double kNoDepth = std::numeric_limits<double>::quiet_NaN();
  PerceptionResult result;
  result.measured.stamp_s = observation.stamp_s;
  const bool measured = observation.kind == TargetObservation::Kind::kLandmarks
                            ? measure_landmarks(observation, vehicle, kNoDepth, params, result)
                            : measure_position(observation, result);
  if (!measured || !is_valid(result.measured)) return std::nullopt;
  return result.measured;
}

void start_at(PerceptionState& state, const TargetState& target) {
  state = {};
  state.count = 1;
  auto& [measurement, estimate] = state.entries[0];
  measurement.stamp_s = estimate.stamp_s = target.stamp_s;
  measurement.position_enu_m = target.position_enu_m;
  measurement.covariance_m2 = target.covariance.topLeftCorner<3, 3>();
  estimate.started = true;
  estimate.mean << target.position_enu_m, target.velocity_enu_m_s;
  estimate.covariance = target.covariance;
  estimate.yaw_rad = target.body_yaw_rad;
  estimate.yaw_variance_rad2 = target.body_yaw_variance_rad2;
  estimate.accepted_s = target.last_measurement_s;
}

TrackStatus track_status(const PerceptionState& state, double now_s,
                         const PerceptionParams& params) {
  if (state.count == 0) return TrackStatus::kNone;
  const TargetEstimate& newest = state.entries[state.count - 1].estimate;
  const double age_s = std::max(now_s, newest.stamp_s) - newest.accepted_s;
  if (age_s <= params.tracking_age_s) return TrackStatus::kTracking;
  return age_s <= params.lost_age_s ? TrackStatus::kCoasting : TrackStatus::kLost;
}

TargetState coast(const PerceptionState& state, double now_s, const PerceptionParams& params) {
  TargetState target;
  target.stamp_s = now_s;
  if (state.count == 0) return target;
  const TargetEstimate& newest = state.entries[state.count - 1].estimate;
  target = target_state(predict_estimate(newest, std::max(now_s, newest.stamp_s), params));
  target.status = track_status(state, now_s, params);
  return target;
}

}  // namespace foretrack
