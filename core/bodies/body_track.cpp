// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/body_track.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/common/white_acceleration.hpp"

namespace foretrack {
namespace {

using Mat24 = Eigen::Matrix<double, 2, 4>;

constexpr double kLeastVariance_m2 = 1e-4;  // so that a detector may call itself exact
constexpr double kSizeLearnt = 0.2;         // of what is new in each sighting
constexpr double kClothesLearnt = 0.2;      // the same, of its clothes
constexpr double kBelieved_s = 0.2;         // for each sighting, after the last one
constexpr double kMostHeight_m = 2.3;       // of what depth images put together

// A sighting measures where the body was at its stamp: p − (track's stamp − stamp) v.
Mat24 observation_of(const BodyTrack& track, double stamp_s) {
  Mat24 h = Mat24::Zero();
  h.leftCols<2>().setIdentity();
  h.rightCols<2>() = (stamp_s - track.stamp_s) * Mat2::Identity();
  return h;
}

Mat2 noise_of(const BodySighting& seen) {
  return seen.covariance_m2 + kLeastVariance_m2 * Mat2::Identity();
}

// People are seen whole. A depth image shows a part: the parts are put together.
void learn_size(BodyTrack& track, const BodySighting& seen) {
  const double foot_m = seen.position_enu_m.z(), top_m = foot_m + seen.height_m;
  track.radius_m += kSizeLearnt * (seen.radius_m - track.radius_m);
  if (seen.kind == BodyKind::kUnknown) {
    if (track.kind != BodyKind::kUnknown) return;
    track.foot_m = std::min(track.foot_m, foot_m);
    track.top_m = std::min(std::max(track.top_m, top_m), track.foot_m + kMostHeight_m);
    return;
  }
  const double share = track.kind == seen.kind ? kSizeLearnt : 1.0;
  track.kind = seen.kind;
  track.foot_m += share * (foot_m - track.foot_m);
  track.top_m += share * (top_m - track.top_m);
}

}  // namespace

BodyTrack begin_track(const BodySighting& seen, double stamp_s, const BodyParams& params) {
  BodyTrack track;
  track.kind = seen.kind;
  track.stamp_s = track.seen_s = stamp_s;
  track.hits = 1;
  track.born_m = seen.position_enu_m.head<2>();
  track.mean.head<2>() = track.born_m;
  track.covariance.setZero();
  track.covariance.topLeftCorner<2, 2>() = noise_of(seen);
  track.covariance.bottomRightCorner<2, 2>() =
      params.initial_speed_sigma_m_s * params.initial_speed_sigma_m_s * Mat2::Identity();
  track.foot_m = seen.position_enu_m.z();
  track.top_m = track.foot_m + seen.height_m;
  track.radius_m = seen.radius_m;
  return track;
}

BodyTrack track_of(const TargetState& target) {
  BodyTrack track;
  track.stamp_s = target.stamp_s;
  track.mean << target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>();
  const auto& c = target.covariance;
  track.covariance << c.topLeftCorner<2, 2>(), c.block<2, 2>(0, 3), c.block<2, 2>(3, 0),
      c.block<2, 2>(3, 3);
  return track;
}

void predict_track(BodyTrack& track, double stamp_s, const BodyParams& params) {
  const double dt = stamp_s - track.stamp_s;
  if (dt <= 0.0) return;
  Mat4 transition = Mat4::Identity();
  transition.topRightCorner<2, 2>() = dt * Mat2::Identity();
  track.stamp_s = stamp_s;
  track.mean = (transition * track.mean).eval();
  track.covariance = (transition * track.covariance * transition.transpose()).eval();
  add_white_acceleration<2>(track.covariance, Vec2::Constant(params.acceleration_density_m2_s3),
                            dt);
}

Match match(const BodyTrack& track, const BodySighting& seen, double stamp_s) {
  const Mat24 h = observation_of(track, stamp_s);
  const Mat2 spread = h * track.covariance * h.transpose() + noise_of(seen);
  const Vec2 innovation = seen.position_enu_m.head<2>() - h * track.mean;
  return {innovation.dot(spread.inverse() * innovation), std::log(spread.determinant())};
}

bool is_over(const BodyTrack& track, double now_s, const BodyParams& params) {
  const double by_hits_s = track.id == 0 ? params.birth_gap_s : kBelieved_s * track.hits;
  return now_s - track.seen_s > std::min(by_hits_s, params.coast_s);
}

void take_look(BodyTrack& track, const PersonLook& look) {
  const std::optional<Appearance> wore = track.look.wears;
  track.look = look;
  if (!wore) return;
  track.look.wears = wore;
  if (look.wears) learn(*track.look.wears, *look.wears, kClothesLearnt);
}

void correct_track(BodyTrack& track, const BodySighting& seen, double stamp_s) {
  const Mat24 h = observation_of(track, stamp_s);
  const Mat2 noise = noise_of(seen);
  const Mat2 spread = h * track.covariance * h.transpose() + noise;
  const Eigen::Matrix<double, 4, 2> gain = track.covariance * h.transpose() * spread.inverse();
  track.mean += gain * (seen.position_enu_m.head<2>() - h * track.mean);
  // Joseph's form keeps it symmetric and positive.
  const Mat4 keep = Mat4::Identity() - gain * h;
  track.covariance =
      (keep * track.covariance * keep.transpose() + gain * noise * gain.transpose()).eval();
  track.seen_s = std::max(track.seen_s, stamp_s);
  ++track.hits;
  learn_size(track, seen);
}

}  // namespace foretrack
