// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/bodies_around.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kPlaceStep_s = 0.2;
constexpr double kPredictionStale_s = 0.5;

MovingBody body_of(const BodyTrack& track) {
  MovingBody body;
  body.id = track.id;
  body.kind = track.kind;
  body.stamp_s = track.stamp_s;
  body.position_enu_m << track.position_m(), track.foot_m;
  body.velocity_enu_m_s << track.velocity_m_s(), 0.0;
  body.position_covariance_m2 = track.covariance.topLeftCorner<2, 2>();
  body.velocity_covariance_m2_s2 = track.covariance.bottomRightCorner<2, 2>();
  body.radius_m = track.radius_m;
  body.height_m = track.top_m - track.foot_m;
  return body;
}

// Where the path has the person from now on, as far as it goes.
void set_places(MovingBody& body, const Prediction& prediction) {
  if (prediction.paths.empty() || prediction.paths.front().states.empty()) return;
  const double now_s = body.stamp_s - prediction.stamp_s;  // of the path
  if (std::abs(now_s) > kPredictionStale_s) return;
  const PredictedPath& path = prediction.paths.front();
  const auto ahead_s = [&] { return (body.place_count + 1) * body.step_s; };
  while (body.place_count < MovingBody::kMaxPlaces &&
         now_s + ahead_s() <= path.states.back().time_s + 1e-9) {
    const Vec3 place_m = path.at(now_s + ahead_s()).position_enu_m;
    body.places_enu_m[body.place_count++] << place_m.head<2>(), body.position_enu_m.z();
  }
}

}  // namespace

MovingBody followed_body(const Followed& followed, double now_s, const BodyParams& params) {
  const TargetState& target = followed.target;
  const double dt = std::max(now_s - target.stamp_s, 0.0);
  MovingBody body;
  body.kind = BodyKind::kPerson;
  body.followed = true;
  body.stamp_s = now_s;
  body.velocity_enu_m_s << target.velocity_enu_m_s.head<2>(), 0.0;
  body.position_enu_m = target.position_enu_m + dt * body.velocity_enu_m_s;
  body.position_enu_m.z() -= kTorsoShare * followed.height_m;
  const auto& c = target.covariance;
  body.position_covariance_m2 = c.topLeftCorner<2, 2>() +
                                dt * (c.block<2, 2>(0, 3) + c.block<2, 2>(3, 0)) +
                                dt * dt * c.block<2, 2>(3, 3);
  body.velocity_covariance_m2_s2 = c.block<2, 2>(3, 3);
  body.radius_m = params.followed_radius_m;
  body.height_m = followed.height_m;
  body.step_s = kPlaceStep_s;
  if (followed.prediction) set_places(body, *followed.prediction);
  return body;
}

void bodies_around(BodiesState& state, double now_s, const Followed& followed,
                   const Vec3& near_enu_m, const BodyParams& params, MovingBodies& out,
                   std::span<PersonLook> looks) {
  out.stamp_s = now_s;
  out.count = 0;
  if (followed.target.usable()) {
    if (state.followed_id == 0) state.followed_id = ++state.last_id;
    MovingBody body = followed_body(followed, now_s, params);
    body.id = state.followed_id;
    out.add(body);
    if (!looks.empty()) looks[0] = state.followed_look;
  }
  struct Near {
    double distance_m;
    int track;
  };
  std::array<Near, BodiesState::kCapacity> order;
  int count = 0;
  for (int k = 0; k < state.count; ++k) {
    const BodyTrack& track = state.tracks[k];
    if (track.id == 0 || is_over(track, now_s, params)) continue;
    order[count++] = {(track.position_m() - near_enu_m.head<2>()).norm(), k};
  }
  std::sort(order.begin(), order.begin() + count, [](const Near& a, const Near& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.track < b.track;
  });
  for (int i = 0; i < count; ++i) {
    BodyTrack track = state.tracks[order[i].track];
    predict_track(track, now_s, params);
    if (!out.add(body_of(track))) return;
    if (!looks.empty()) looks[out.count - 1] = track.look;
  }
}

}  // namespace foretrack
