// SPDX-License-Identifier: Apache-2.0
// One body that is tracked: a Kalman filter of constant horizontal velocity, and its size.
#pragma once

#include "core/bodies/params.hpp"
#include "core/common/body_sighting.hpp"
#include "core/common/person_look.hpp"

namespace foretrack {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// A plain value. World ENU.
struct BodyTrack {
  std::uint32_t id = 0;  ///< 0: not believed yet
  BodyKind kind = BodyKind::kUnknown;
  double stamp_s = 0.0;                ///< of mean and covariance
  double seen_s = 0.0;                 ///< of the last sighting
  int hits = 0;                        ///< sightings so far
  Vec4 mean = Vec4::Zero();            ///< horizontal position and velocity
  Mat4 covariance = Mat4::Identity();  ///< of the mean
  Vec2 born_m = Vec2::Zero();          ///< about where it was seen first
  double foot_m = 0.0, top_m = 0.0;    ///< heights of its faces
  double radius_m = 0.0;
  PersonLook look;

  Vec2 position_m() const { return mean.head<2>(); }
  Vec2 velocity_m_s() const { return mean.tail<2>(); }
};

/// A track of what was seen once.
BodyTrack begin_track(const BodySighting& seen, double stamp_s, const BodyParams& params);

/// The followed person as a track, so that a sighting of them can be assigned to them: mean and
/// covariance alone.
BodyTrack track_of(const TargetState& target);

/// On to a time; no change for one that is past. White acceleration as process noise.
void predict_track(BodyTrack& track, double stamp_s, const BodyParams& params);

/// Squared Mahalanobis distance of a sighting, and the logarithm of its covariance's determinant:
/// together −2 ln of its likelihood, but for a constant. A sighting of before the track's stamp is
/// compared with where the body was then.
struct Match {
  double mahalanobis2 = 0.0;
  double log_determinant = 0.0;
  double cost() const { return mahalanobis2 + log_determinant; }
};
/// How well a sighting fits a track, by its likelihood.
Match match(const BodyTrack& track, const BodySighting& seen, double stamp_s);

/// Not seen for too long. Who was seen but a few times is not believed for long.
bool is_over(const BodyTrack& track, double now_s, const BodyParams& params);

/// What an image shows of it; its clothes are averaged over some looks.
void take_look(BodyTrack& track, const PersonLook& look);

/// The filter's correction; size and kind follow what is seen.
void correct_track(BodyTrack& track, const BodySighting& seen, double stamp_s);

}  // namespace foretrack
