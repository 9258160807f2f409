// SPDX-License-Identifier: Apache-2.0
// What this vehicle would see of the person from each seat, if they do this or that.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/fleet/fleet_member.hpp"
#include "core/fleet/fleet_params.hpp"

namespace foretrack {

/// What bids are made from.
struct BidInput {
  double now_s = 0.0;
  Vec3 own_enu_m = Vec3::Zero();
  double own_radius_m = 0.25;
  Vec3 person_enu_m = Vec3::Zero();        ///< the torso's centre, now
  const Prediction* prediction = nullptr;  ///< null, or without paths: they stand
  const GridMap* map = nullptr;            ///< null: nothing is in the way
};

/// Where a seat is beside a person: as far out as wanted, or as there is room in that direction.
/// Negative: there is too little.
double seat_distance_m(const GridMap* map, const Vec3& person_enu_m, double bearing_rad,
                       SeatRing ring, double radius_m, const FleetParams& params);

/// For each seat: the way there, and for each intention the share of the next look_ahead_s in which
/// the person is seen from beside them in that direction, as soon as the vehicle can be there. Less
/// than 3 % probable intentions are not looked at. Cost: about 250 rays, 0.1 ms.
std::array<SeatBid, kSeatCount> bid_for_seats(const BidInput& input, const FleetParams& params);

}  // namespace foretrack
