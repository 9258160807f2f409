// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/peer_body.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kPlaceStep_s = 0.2;
constexpr double kFit_m = 0.05;  // that the body at least stays away from this vehicle's own hull

// Numbers of bodies that perception tracks count up from one; those of peers do not meet them.
std::uint32_t id_of(std::string_view name) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash | 0x80000000U;
}

double grown_m(double age_s, const FleetParams& params) {
  return std::min(params.growth_m_s * std::max(age_s - params.silent_s, 0.0), params.growth_max_m);
}

Vec3 place_of(const FleetMember& peer, double time_s) {
  if (!peer.plan.empty()) return peer.plan.position(time_s);
  return peer.position_enu_m + std::max(time_s - peer.stamp_s, 0.0) * peer.velocity_enu_m_s;
}

}  // namespace

MovingBody peer_body(const FleetMember& peer, const PeerView& view, const FleetParams& params) {
  const double age_s = std::max(view.now_s - peer.stamp_s, 0.0);
  const double kept_m =
      params.separation_m + (view.gives_way ? params.yield_m : 0.0) - view.gap_min_m;
  const double least_m = peer.radius_m + std::max(kept_m, 0.0);
  const auto foot = [&](double time_s) {
    return Vec3(place_of(peer, time_s) - Vec3(0.0, 0.0, params.downwash_m));
  };
  MovingBody body;
  body.id = id_of(peer.vehicle.view());
  body.kind = BodyKind::kVehicle;
  body.stamp_s = view.now_s;
  body.step_s = kPlaceStep_s;
  body.position_enu_m = foot(view.now_s);
  const Vec3 next = foot(view.now_s + kPlaceStep_s);
  body.velocity_enu_m_s << (next - body.position_enu_m).head<2>() / kPlaceStep_s, 0.0;
  body.height_m = 2.0 * params.downwash_m;
  const double wanted_m = least_m + grown_m(age_s, params) + 2.0 * view.frame_sigma_m;
  const double room_m =
      distance_xy(body.position_enu_m, view.own_enu_m) - peer.radius_m - view.gap_min_m - kFit_m;
  body.radius_m = std::max(std::min(wanted_m, room_m), std::min(least_m, wanted_m));
  for (int i = 0; i < MovingBody::kMaxPlaces; ++i)
    body.places_enu_m[body.place_count++] = foot(view.now_s + (i + 1) * kPlaceStep_s);
  return body;
}

bool gives_way(const FleetMember& own, const FleetMember& peer) {
  return own.vehicle.view() > peer.vehicle.view();
}

}  // namespace foretrack
