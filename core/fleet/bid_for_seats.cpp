// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/bid_for_seats.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr int kLooks = 4;  // over the time ahead
constexpr double kWallGap_m = 0.15;  // between the vehicle's ball and what stands behind its seat
constexpr double kUnlikely = 0.03;

// Free length beside the person in a direction, as far as seats go.
double room_m(const GridMap* map, const Vec3& person_m, double bearing_rad, double reach_m) {
  if (!map) return reach_m;
  const Vec2 d = direction_of(bearing_rad);
  return ray_distance_m(*map, person_m, Vec3(d.x(), d.y(), 0.0), reach_m);
}

double distance_m(double room, SeatRing ring, double radius_m, const FleetParams& p) {
  const double fits_m = room - radius_m - kWallGap_m;
  if (ring == SeatRing::kNear) return fits_m < p.near_m ? -1.0 : p.near_m;
  const double far_m = std::min(p.far_m, fits_m);
  return far_m < p.far_least_m ? -1.0 : far_m;
}

double reach_m(double radius_m, const FleetParams& p) {
  return std::max(p.far_m, p.near_m) + radius_m + kWallGap_m + 0.01;
}

// One direction over one path: at each look, whether there is a place in either ring, and whether
// the vehicle can be there by then.
class Looking {
 public:
  Looking(const BidInput& in, const FleetParams& params) : in_(in), params_(params) {}

  void look(const PredictedPath* path, int place, int sector,
            std::array<SeatBid, kSeatCount>& bids) const {
    const double bearing_rad = Seat::of(sector, SeatRing::kNear).bearing_rad();
    const double reach = reach_m(in_.own_radius_m, params_);
    for (int k = 1; k <= kLooks; ++k) {
      const double ahead_s = params_.look_ahead_s * k / kLooks;
      const Vec3 person = place_on(path, ahead_s);
      const double room = room_m(in_.map, person, bearing_rad, reach);
      for (const SeatRing ring : {SeatRing::kNear, SeatRing::kFar}) {
        const double d = distance_m(room, ring, in_.own_radius_m, params_);
        if (d < 0.0) continue;
        const Vec2 seat = person.head<2>() + d * direction_of(bearing_rad);
        const double way_s = (seat - in_.own_enu_m.head<2>()).norm() / params_.speed_m_s;
        SeatBid& bid = bids[Seat::of(sector, ring).number];
        // Who is late by a second sees half as much: the way leads past places that see, too.
        const double late_s = std::max(way_s - ahead_s, 0.0);
        bid.sees[place] += static_cast<float>(1.0 / (1.0 + late_s) / kLooks);
        if (k == 1) bid.way_s = std::min(static_cast<float>(way_s), SeatBid::kCannot_s - 0.1F);
      }
    }
  }

 private:
  Vec3 place_on(const PredictedPath* path, double ahead_s) const {
    if (!path || path->states.empty()) return in_.person_enu_m;
    const double t_s = std::min(in_.now_s - in_.prediction->stamp_s + ahead_s,
                                path->states.back().time_s);
    Vec3 place = path->at(t_s).position_enu_m;
    place.z() = in_.person_enu_m.z();
    return place;
  }

  const BidInput& in_;
  const FleetParams& params_;
};

}  // namespace

double seat_distance_m(const GridMap* map, const Vec3& person_enu_m, double bearing_rad,
                       SeatRing ring, double radius_m, const FleetParams& params) {
  return distance_m(room_m(map, person_enu_m, bearing_rad, reach_m(radius_m, params)), ring,
                    radius_m, params);
}

std::array<SeatBid, kSeatCount> bid_for_seats(const BidInput& in, const FleetParams& params) {
  std::array<SeatBid, kSeatCount> bids{};
  const Looking looking(in, params);
  const bool predicted = in.prediction && !in.prediction->paths.empty();
  for (int sector = 0; sector < kSeatSectors; ++sector) {
    if (!predicted) looking.look(nullptr, 0, sector, bids);
    else
      for (const PredictedPath& path : in.prediction->paths)
        if (path.probability >= kUnlikely && index_of(path.intention) < kMaxIntentions)
          looking.look(&path, index_of(path.intention), sector, bids);
  }
  return bids;
}

}  // namespace foretrack
