// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/bid_for_seats.hpp"

#include <algorithm>
#include <limits>

namespace foretrack {
namespace {

constexpr int kLooks = 4;            // over the time ahead
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

int step_to(int sector, int steps) {
  return ((sector + steps) % kSeatSectors + kSeatSectors) % kSeatSectors;
}

// One direction over one path: at each look, whether there is a place in either ring, and whether
// the vehicle can be there by then.
class Looking {
 public:
  Looking(const BidInput& in, const FleetParams& params) : in_(in), params_(params) {
    const double reach = reach_m(in_.own_radius_m, params_);
    for (int sector = 0; sector < kSeatSectors; ++sector)
      room_m_[sector] = room_m(in_.map, in_.person_enu_m, bearing_of(sector), reach);
    find_ways();
  }

  void look(const PredictedPath* path, int place, int sector,
            std::array<SeatBid, kSeatCount>& bids) const {
    if (!std::isfinite(way_rad_[sector])) return;
    const double bearing_rad = bearing_of(sector);
    const double reach = reach_m(in_.own_radius_m, params_);
    for (int k = 1; k <= kLooks; ++k) {
      const double ahead_s = params_.look_ahead_s * k / kLooks;
      const double room = room_m(in_.map, place_on(path, ahead_s), bearing_rad, reach);
      for (const SeatRing ring : {SeatRing::kNear, SeatRing::kFar}) {
        SeatBid& bid = bids[Seat::of(sector, ring).number];
        if (!bid.possible() || distance_m(room, ring, in_.own_radius_m, params_) < 0.0) continue;
        // Who is late by a second sees half as much: the way leads past places that see, too.
        const double late_s = std::max(bid.way_s - ahead_s, 0.0);
        bid.sees[place] += static_cast<float>(1.0 / (1.0 + late_s) / kLooks);
      }
    }
  }

  // Round the person through what is free, and out or in.
  void set_ways(std::array<SeatBid, kSeatCount>& bids) const {
    const double out_m = (in_.own_enu_m - in_.person_enu_m).head<2>().norm();
    for (int sector = 0; sector < kSeatSectors; ++sector)
      for (const SeatRing ring : {SeatRing::kNear, SeatRing::kFar}) {
        const double d = distance_m(room_m_[sector], ring, in_.own_radius_m, params_);
        if (d < 0.0 || !std::isfinite(way_rad_[sector])) continue;
        const double way_m = way_rad_[sector] * std::max(d, params_.near_m) + std::abs(out_m - d);
        bids[Seat::of(sector, ring).number].way_s =
            std::min(static_cast<float>(way_m / params_.speed_m_s), SeatBid::kCannot_s - 0.1F);
      }
  }

 private:
  static double bearing_of(int sector) { return Seat::of(sector, SeatRing::kNear).bearing_rad(); }

  bool is_open(int sector) const {
    return distance_m(room_m_[sector], SeatRing::kNear, in_.own_radius_m, params_) > 0.0;
  }

  // Angle to go to each sector, past open ones only; infinite: there is no such way.
  void find_ways() {
    way_rad_.fill(std::numeric_limits<double>::infinity());
    const double own_rad = yaw_of(Vec2((in_.own_enu_m - in_.person_enu_m).head<2>()));
    constexpr double kSector_rad = 2.0 * kPi / kSeatSectors;
    const int start = step_to(static_cast<int>(std::lround(own_rad / kSector_rad)), 0);
    for (const int sense : {1, -1})
      for (int n = 0; n <= kSeatSectors / 2; ++n) {
        const int sector = step_to(start, sense * n);
        if (n > 1 && !is_open(sector)) break;
        const double angle = std::abs(wrap_angle(bearing_of(sector) - own_rad));
        way_rad_[sector] = std::min(way_rad_[sector], std::max(angle, (n - 1) * kSector_rad));
        if (n == 1 && !is_open(sector)) break;
      }
  }

  Vec3 place_on(const PredictedPath* path, double ahead_s) const {
    if (!path || path->states.empty()) return in_.person_enu_m;
    const double t_s =
        std::min(in_.now_s - in_.prediction->stamp_s + ahead_s, path->states.back().time_s);
    Vec3 place = path->at(t_s).position_enu_m;
    place.z() = in_.person_enu_m.z();
    return place;
  }

  const BidInput& in_;
  const FleetParams& params_;
  std::array<double, kSeatSectors> room_m_{}, way_rad_{};
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
  looking.set_ways(bids);
  const bool predicted = in.prediction && !in.prediction->paths.empty();
  for (int sector = 0; sector < kSeatSectors; ++sector) {
    if (!predicted)
      looking.look(nullptr, 0, sector, bids);
    else
      for (const PredictedPath& path : in.prediction->paths)
        if (path.probability >= kUnlikely && index_of(path.intention) < kMaxIntentions)
          looking.look(&path, index_of(path.intention), sector, bids);
  }
  return bids;
}

}  // namespace foretrack
