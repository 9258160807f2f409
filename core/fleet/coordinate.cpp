// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/coordinate.hpp"

#include <algorithm>
#include <limits>

#include "core/fleet/bid_for_seats.hpp"
#include "core/fleet/fuse_target.hpp"
#include "core/fleet/peer_body.hpp"

namespace foretrack {
namespace {

constexpr double kSamePerson_m = 2.5;  // farther apart, two vehicles follow two people
constexpr double kPlanAhead_s = 4.0;   // of it others are told

FleetPerson person_of(const FleetInput& in) {
  FleetPerson person;
  person.id = in.person;
  person.status = in.target.status;
  person.in_sight = in.target.status == TrackStatus::kTracking;
  person.position_enu_m = in.target.position_enu_m;
  person.velocity_enu_m_s = in.target.velocity_enu_m_s;
  person.covariance = in.target.covariance;
  return at_time(person, in.target.stamp_s, in.now_s);
}

void tell_plan(const FleetInput& in, FleetPlan& out) {
  if (!in.plan || in.plan->pieces.empty()) return;
  out.start_s = in.plan->start_s;
  double end_s = in.plan->start_s;
  for (const QuinticPiece& piece : in.plan->pieces) {
    end_s += piece.duration_s;
    if (end_s < in.now_s) {  // flown already
      out.start_s = end_s;
      continue;
    }
    if (out.count == FleetPlan::kMaxPieces || end_s - piece.duration_s > in.now_s + kPlanAhead_s)
      return;
    out.pieces[out.count++] = piece;
  }
}

FleetMember message_of(FleetState& state, const FleetInput& in) {
  FleetMember out;
  out.vehicle = in.vehicle;
  out.frame = in.frame;
  out.stamp_s = in.now_s;
  out.sequence_number = ++state.sequence_number;
  out.flies = in.flies;
  out.position_enu_m = in.state.position_enu_m;
  out.velocity_enu_m_s = in.state.velocity_enu_m_s;
  out.yaw_rad = in.state.yaw_rad();
  out.radius_m = in.radius_m;
  out.battery = in.battery;
  tell_plan(in, out.plan);
  if (in.target.status != TrackStatus::kNone) {
    out.follows = in.person;
    out.persons[out.person_count++] = person_of(in);
  }
  if (in.intention) {
    out.intention_count = in.intention->count;
    for (int i = 0; i < out.intention_count; ++i)
      out.intentions[i] = static_cast<float>(in.intention->beliefs[i].probability);
  }
  out.seat = state.seat;
  out.is_near = state.is_near;
  return out;
}

// Both see the person: their frames are put together, and their words compared.
void meet(FleetPeer& peer, const FleetMember& own, const FleetParams& params) {
  const bool common = peer.told.frame == own.frame;
  if (peer.told.sees_followed() && own.sees_followed() && !common)
    add_pair(peer.pairs, peer.told.stamp_s, peer.told.followed()->position_enu_m,
             at_time(*own.followed(), own.stamp_s, peer.told.stamp_s).position_enu_m +
                 std::min(peer.told.stamp_s - own.stamp_s, 0.0) * own.followed()->velocity_enu_m_s,
             params);
  if (common)
    peer.alignment = {.yaw_sigma_rad = 0.0, .position_sigma_m = 0.0};
  else
    peer.alignment = align_frame(peer.pairs);
  peer.ours = in_our_frame(peer.told, peer.alignment);
}

bool follows_same(const FleetPeer& peer, const FleetPerson* person, double now_s) {
  const FleetPerson* theirs = peer.ours.followed();
  if (!theirs || !person) return true;  // whoever sees nobody follows whom the others see
  return distance_xy(at_time(*theirs, peer.ours.stamp_s, now_s).position_enu_m,
                     person->position_enu_m) < kSamePerson_m;
}

bool can_compare(const FleetPeer& peer, const FleetMember& own) {
  return peer.ours.sees_followed() && own.sees_followed() &&
         follows_same(peer, own.followed(), own.stamp_s);
}

bool disagrees(const FleetPeer& peer, const FleetMember& own, const FleetParams& params) {
  const FleetPerson theirs = at_time(*peer.ours.followed(), peer.ours.stamp_s, own.stamp_s);
  return apart2(theirs, *own.followed()) > params.gate_mahalanobis * params.gate_mahalanobis;
}

// Who lied stays a liar until both see the person again.
void judge(FleetPeer& peer, const FleetMember& own, const FleetParams& params) {
  const bool common = peer.told.frame == own.frame;
  if (!common && !peer.alignment.is_sure(params)) {
    peer.trust = FleetTrust::kUnaligned;
    peer.disagrees_since_s = -1.0;
    return;
  }
  const bool compares = can_compare(peer, own);
  if (!compares && peer.trust == FleetTrust::kLiar) return;
  if (!compares || !disagrees(peer, own, params))
    peer.disagrees_since_s = -1.0;
  else if (peer.disagrees_since_s < 0.0)
    peer.disagrees_since_s = own.stamp_s;
  const bool lies =
      peer.disagrees_since_s >= 0.0 && own.stamp_s - peer.disagrees_since_s >= params.liar_s;
  if (lies)
    peer.trust = FleetTrust::kLiar;
  else
    peer.trust = common ? FleetTrust::kCommon : FleetTrust::kAligned;
}

bool is_believed(const FleetPeer& peer) {
  return peer.trust == FleetTrust::kCommon || peer.trust == FleetTrust::kAligned;
}

bool is_heard(const FleetPeer& peer, double now_s, const FleetParams& params) {
  return now_s - peer.heard_s <= params.silent_s;
}

// Who sees the person goes by its own eyes. Who does not goes by the others'.
TargetState fuse(const FleetState& state, const FleetInput& in, const FleetMember& own,
                 const FleetParams& params) {
  if (own.sees_followed()) return in.target;
  FleetPerson fused;
  bool any = false;
  for (const FleetPeer& peer : state.all()) {
    if (!is_believed(peer) || !is_heard(peer, in.now_s, params) || !peer.ours.sees_followed())
      continue;
    const FleetPerson theirs = at_time(*peer.ours.followed(), peer.ours.stamp_s, in.now_s);
    if (any && apart2(theirs, fused) > params.gate_mahalanobis * params.gate_mahalanobis) continue;
    fused = any ? intersect(fused, theirs) : theirs;
    any = true;
  }
  if (!any) return in.target;
  TargetState out;
  out.stamp_s = out.last_measurement_s = in.now_s;
  out.status = TrackStatus::kTracking;
  out.position_enu_m = fused.position_enu_m;
  out.velocity_enu_m_s = fused.velocity_enu_m_s;
  out.covariance = fused.covariance;
  return out;
}

// All who follow the same person and are believed, this vehicle among them, sorted by name.
int gather(const FleetState& state, const FleetMember& own, const TargetState& target,
           const FleetParams& params, std::array<FleetMember, kFleetCapacity>& out) {
  FleetPerson person;
  person.position_enu_m = target.position_enu_m;
  int count = 0;
  out[count++] = own;
  for (const FleetPeer& peer : state.all())
    if (is_believed(peer) && is_heard(peer, own.stamp_s, params) && peer.ours.flies &&
        follows_same(peer, target.usable() ? &person : nullptr, own.stamp_s))
      out[count++] = peer.ours;
  std::sort(out.begin(), out.begin() + count, [](const FleetMember& a, const FleetMember& b) {
    return a.vehicle.view() < b.vehicle.view();
  });
  return count;
}

// The part of a fleet that holds more than half of those who fly, or half and the first by name,
// stays where it is; each other part has a layer of its own, the higher the more of the silent come
// before it by name. All parts come to that order without a word. Where one vehicle has died, all
// others are that part.
int layer_of(const FleetState& state, const FleetMember& own, const FleetParams& params) {
  std::string_view first = own.vehicle.view();
  int heard = 1, silent = 0, before = 0;
  for (const FleetPeer& peer : state.all()) {
    if (!peer.ours.flies || !is_heard(peer, own.stamp_s, params)) continue;
    first = std::min(first, peer.told.vehicle.view());
    ++heard;
  }
  for (const FleetPeer& peer : state.all()) {
    if (!peer.ours.flies || is_heard(peer, own.stamp_s, params)) continue;
    before += peer.told.vehicle.view() < first;
    ++silent;
  }
  if (heard > silent) return 0;
  return before + (heard < silent ? 1 : 0);
}

// Somebody has just fallen silent: both sides are still on their way to their layers.
bool is_just_parted(const FleetState& state, double now_s, const FleetParams& params) {
  return std::ranges::any_of(state.all(), [&](const FleetPeer& peer) {
    return peer.ours.flies && !is_heard(peer, now_s, params) &&
           now_s - peer.heard_s < params.layer_change_s;
  });
}

// The others expect it in the seat that it had when they were heard last.
void keep_seat(const FleetState& state, const FleetParams& params, SeatPlace& out) {
  out.is_alone = false;
  out.ring = state.is_near ? SeatRing::kNear : SeatRing::kFar;
  out.seat = state.seat;
  out.bearing_rad = out.seat.is_none() ? 0.0 : out.seat.bearing_rad();
  out.distance_m = state.is_near ? params.near_m : params.far_m;
}

// While somebody is silent, the part of the fleet that is heard flies on by itself, on its layer.
void place_layer(const FleetState& state, const FleetMember& own, const FleetParams& params,
                 SeatPlace& out) {
  if (is_just_parted(state, own.stamp_s, params)) keep_seat(state, params, out);
  const int layer = layer_of(state, own, params);
  if (layer == 0) return;
  out.is_alone = false;
  out.ring = SeatRing::kFar;
  if (!out.seat.is_none()) out.seat = Seat::of(out.seat.sector(), out.ring);
  out.distance_m = params.far_m;
  out.height_m = layer * params.layer_m;
}

void place_seat(const FleetInput& in, const TargetState& target, const FleetParams& params,
                FleetResult& out) {
  const FleetPart* part = out.division.part_of(in.vehicle.view());
  if (out.division.count < 2 || !part) return;
  out.place = {.is_alone = false,
               .ring = part->ring,
               .seat = part->seat,
               .distance_m = part->ring == SeatRing::kNear ? params.near_m : params.far_m};
  if (part->seat.is_none()) return;
  out.place.bearing_rad = part->seat.bearing_rad();
  const double room_m = seat_distance_m(in.map, target.position_enu_m, out.place.bearing_rad,
                                        part->ring, in.radius_m, params);
  if (room_m > 0.0) out.place.distance_m = room_m;
}

void keep_clear(const FleetState& state, const FleetInput& in, const FleetMember& own,
                const FleetParams& params, FleetResult& out) {
  out.peers.stamp_s = in.now_s;
  out.separation_m = std::numeric_limits<double>::infinity();
  for (const FleetPeer& peer : state.all()) {
    const double sigma_m = peer.alignment.position_sigma_m;
    if (peer.trust == FleetTrust::kUnaligned && sigma_m > params.growth_max_m) continue;
    const PeerView view{.now_s = in.now_s,
                        .own_enu_m = in.state.position_enu_m,
                        .gap_min_m = in.gap_min_m,
                        .gives_way = gives_way(own, peer.ours),
                        .frame_sigma_m = sigma_m,
                        .person = &out.target};
    MovingBody follows;
    out.peers.add(peer_body(peer.ours, view, params));
    const bool may_follow = in.now_s - peer.heard_s < params.layer_change_s;
    if (may_follow && out.target.usable() && following_body(peer.ours, view, params, follows))
      out.peers.add(follows);
    const double apart_m = (peer.ours.position_enu_m - own.position_enu_m).norm();
    out.separation_m = std::min(out.separation_m, apart_m - own.radius_m - peer.ours.radius_m);
  }
}

}  // namespace

FleetResult coordinate(FleetState& state, const FleetInput& in, const FleetParams& params) {
  FleetResult out;
  forget(state, in.now_s, params);
  out.message = message_of(state, in);
  for (FleetPeer& peer : state.all()) {
    meet(peer, out.message, params);
    judge(peer, out.message, params);
  }
  out.target = fuse(state, in, out.message, params);
  if (out.target.usable())
    out.message.bids = bid_for_seats({.now_s = in.now_s,
                                      .own_enu_m = in.state.position_enu_m,
                                      .own_radius_m = in.radius_m,
                                      .person_enu_m = out.target.position_enu_m,
                                      .prediction = in.prediction,
                                      .map = in.map},
                                     params);
  for (SeatBid& bid : out.message.bids) bid = as_told(bid);
  std::array<FleetMember, kFleetCapacity> members;
  const int count = gather(state, out.message, out.target, params, members);
  out.division = divide({members.data(), static_cast<std::size_t>(count)}, params);
  place_seat(in, out.target, params, out);
  place_layer(state, out.message, params, out.place);
  state.seat = out.place.seat;
  state.is_near = !out.place.is_alone && out.place.ring == SeatRing::kNear;
  keep_clear(state, in, out.message, params, out);
  return out;
}

}  // namespace foretrack
