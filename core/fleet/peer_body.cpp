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

// By what may have happened since: it planned anew, or it is silent.
double grown_m(double age_s, const FleetParams& params) {
  const double told_s = std::min(age_s, params.silent_s);
  return std::min(0.5 * params.replan_m_s2 * told_s * told_s, params.replan_max_m) +
         std::min(params.growth_m_s * std::max(age_s - params.silent_s, 0.0), params.growth_max_m);
}

double least_radius_m(const FleetMember& peer, const PeerView& view, const FleetParams& params) {
  const double kept_m = params.separation_m + params.margin_m +
                        (view.gives_way ? params.yield_m : 0.0) - view.gap_min_m;
  return peer.radius_m + std::max(kept_m, 0.0);
}

Vec3 place_of(const FleetMember& peer, double time_s) {
  if (!peer.plan.empty()) return peer.plan.position(time_s);
  return peer.position_enu_m + std::max(time_s - peer.stamp_s, 0.0) * peer.velocity_enu_m_s;
}

// The body at those places, as large as wanted and as there is room beside this vehicle.
template <class Place>
MovingBody body_at(const FleetMember& peer, const PeerView& view, const FleetParams& params,
                   double grown, const Place& place) {
  const Vec3 under(0.0, 0.0, params.downwash_m);
  MovingBody body;
  body.id = id_of(peer.vehicle.view());
  body.kind = BodyKind::kVehicle;
  body.stamp_s = view.now_s;
  body.step_s = kPlaceStep_s;
  body.position_enu_m = place(view.now_s) - under;
  const Vec3 next = place(view.now_s + kPlaceStep_s) - under;
  body.velocity_enu_m_s << (next - body.position_enu_m).head<2>() / kPlaceStep_s, 0.0;
  body.height_m = 2.0 * params.downwash_m;
  const double least_m = least_radius_m(peer, view, params);
  const double wanted_m = least_m + grown + 2.0 * view.frame_sigma_m;
  const double room_m =
      distance_xy(body.position_enu_m, view.own_enu_m) - peer.radius_m - view.gap_min_m - kFit_m;
  body.radius_m = std::max(std::min(wanted_m, room_m), std::min(least_m, wanted_m));
  for (int i = 0; i < MovingBody::kMaxPlaces; ++i)
    body.places_enu_m[body.place_count++] = place(view.now_s + (i + 1) * kPlaceStep_s) - under;
  return body;
}

}  // namespace

MovingBody peer_body(const FleetMember& peer, const PeerView& view, const FleetParams& params) {
  const double age_s = std::max(view.now_s - peer.stamp_s, 0.0);
  return body_at(peer, view, params, grown_m(age_s, params),
                 [&](double time_s) { return place_of(peer, time_s); });
}

bool following_body(const FleetMember& peer, const PeerView& view, const FleetParams& params,
                    MovingBody& body) {
  const FleetPerson* knew = peer.followed();
  if (!peer.flies || !knew || view.now_s - peer.stamp_s <= params.silent_s) return false;
  const Vec3 beside = peer.position_enu_m - knew->position_enu_m;
  const TargetState& person = *view.person;
  body = body_at(peer, view, params, 0.0, [&](double time_s) {
    return Vec3(person.position_enu_m + (time_s - person.stamp_s) * person.velocity_enu_m_s +
                beside);
  });
  body.id ^= 1U;  // not the one that stops
  return true;
}

bool gives_way(const FleetMember& own, const FleetMember& peer) {
  return own.vehicle.view() > peer.vehicle.view();
}

}  // namespace foretrack
