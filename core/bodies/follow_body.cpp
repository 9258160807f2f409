// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/follow_body.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kVerticalSigma_m = 0.1;  // of a torso of which the feet are known
constexpr double kVerticalSpeedSigma_m_s = 0.2;
constexpr int kHitsOfFollowed = 10;  // who was followed is believed for as long as anybody

void set_planar(const Mat4& planar, Mat6& all) {
  all.topLeftCorner<2, 2>() = planar.topLeftCorner<2, 2>();
  all.block<2, 2>(0, 3) = planar.topRightCorner<2, 2>();
  all.block<2, 2>(3, 0) = planar.bottomLeftCorner<2, 2>();
  all.block<2, 2>(3, 3) = planar.bottomRightCorner<2, 2>();
}

TargetState target_of(const BodyTrack& track, double height_m) {
  TargetState target;
  target.stamp_s = track.stamp_s;
  target.status = TrackStatus::kTracking;
  target.position_enu_m << track.position_m(), track.foot_m + kTorsoShare * height_m;
  target.velocity_enu_m_s << track.velocity_m_s(), 0.0;
  target.covariance.setZero();
  set_planar(track.covariance, target.covariance);
  target.covariance(2, 2) = kVerticalSigma_m * kVerticalSigma_m;
  target.covariance(5, 5) = kVerticalSpeedSigma_m_s * kVerticalSpeedSigma_m_s;
  target.body_yaw_rad = track.look.body_yaw_rad;
  target.last_measurement_s = track.seen_s;
  return target;
}

BodyTrack followed_track(const BodiesState& state, const TargetState& target, double height_m,
                         const BodyParams& params) {
  BodyTrack track = track_of(target);
  track.id = state.followed_id;
  track.kind = BodyKind::kPerson;
  track.seen_s = target.last_measurement_s;
  track.hits = std::max(params.birth_hits, kHitsOfFollowed);
  track.born_m = track.position_m();
  track.foot_m = target.position_enu_m.z() - kTorsoShare * height_m;
  track.top_m = track.foot_m + height_m;
  track.radius_m = params.followed_radius_m;
  track.look = state.followed_look;
  return track;
}

}  // namespace

std::optional<TargetState> follow_body(BodiesState& state, std::uint32_t id,
                                       const TargetState& before, Numbers numbers, double height_m,
                                       const BodyParams& params) {
  const auto end = state.tracks.begin() + state.count;
  const auto it = std::find_if(state.tracks.begin(), end,
                               [&](const BodyTrack& track) { return track.id == id; });
  if (id == 0 || it == end) return std::nullopt;
  const BodyTrack chosen = *it;
  if (before.usable() && state.followed_id != 0) {
    *it = followed_track(state, before, height_m, params);
    if (numbers == Numbers::kSwap) it->id = id;
  } else {
    std::move(it + 1, end, it);
    --state.count;
  }
  if (numbers == Numbers::kStay || state.followed_id == 0) state.followed_id = id;
  state.followed_look = chosen.look;
  return target_of(chosen, height_m);
}

void follow_no_body(BodiesState& state, const TargetState& before, double height_m,
                    const BodyParams& params) {
  if (before.usable() && state.followed_id != 0 && state.count < BodiesState::kCapacity)
    state.tracks[state.count++] = followed_track(state, before, height_m, params);
  state.followed_id = 0;
  state.followed_look = {};
}

}  // namespace foretrack
