// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/use_fleet.hpp"

namespace foretrack {

const TargetState& seen_by_any(const TargetState& own, const TargetState& told, double now_s) {
  const bool helps = own.status != TrackStatus::kTracking &&
                     told.status == TrackStatus::kTracking && now_s - told.stamp_s < kFleetStale_s;
  return helps ? told : own;
}

Framing framing_of(const Framing& ordered, const SeatPlace& place, const FleetParams& params) {
  if (place.is_alone || !ordered.is_free()) return ordered;
  Framing framing = ordered;
  framing.is_seat = true;
  if (place.ring == SeatRing::kFar) framing.distance_m = place.distance_m;
  if (place.height_m > 0.0) framing.height_m = place.height_m;
  if (!place.seat.is_none() && params.directions) framing.bearing_enu_rad = place.bearing_rad;
  return framing;
}

MovingBodies all_of(const MovingBodies& around, const MovingBodies& peers, double now_s) {
  MovingBodies all = around;
  if (now_s - peers.stamp_s > kPeersStale_s) return all;
  for (const MovingBody& peer : peers.all()) all.add(peer);
  return all;
}

}  // namespace foretrack
