// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/divide.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace foretrack {
namespace {

constexpr int kRounds = 4;
constexpr float kTrust = 0.9F;  // that who would see them does: two eyes are better than one
constexpr double kNever = -1e9;
constexpr double kFar_m = 1e6;

class Dividing {
 public:
  Dividing(std::span<const FleetMember> members, const FleetParams& params, FleetDivision& out)
      : members_(members), params_(params), out_(out) {}

  void run() {
    near_ = choose_near();
    for (std::size_t v = 0; v < members_.size(); ++v) {
      const Seat held = members_[v].seat;
      const bool fits = !held.is_none() && ring_of(v) == held.ring() && bid(v, held).possible();
      out_.parts[v].seat = fits ? held : Seat{};
    }
    bool changes = true;
    for (int round = 0; round < kRounds && changes; ++round) {
      changes = false;
      for (std::size_t v = 0; v < members_.size(); ++v) changes |= take_best(v);
    }
  }

  double sight() const {
    double sum = 0.0;
    for (int i = 0; i < out_.intention_count; ++i) {
      double missed = 1.0;
      for (std::size_t v = 0; v < members_.size(); ++v)
        if (!out_.parts[v].seat.is_none())
          missed *= 1.0 - kTrust * bid(v, out_.parts[v].seat).sees[i];
      sum += out_.intentions[i] * (1.0 - missed);
    }
    return sum;
  }

  std::size_t near() const { return near_; }

 private:
  const SeatBid& bid(std::size_t v, Seat seat) const { return members_[v].bids[seat.number]; }
  SeatRing ring_of(std::size_t v) const { return v == near_ ? SeatRing::kNear : SeatRing::kFar; }

  // Who is near stays so for as long as they know where the person is: to change over takes time in
  // which nobody is there. Else the nearest of those who see them.
  std::size_t choose_near() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < members_.size(); ++v) {
      const FleetPerson* person = members_[v].followed();
      const bool knows = person && (person->status == TrackStatus::kTracking ||
                                    person->status == TrackStatus::kCoasting);
      double cost =
          knows ? distance_xy(members_[v].position_enu_m, person->position_enu_m) : kFar_m;
      if (knows && members_[v].is_near) cost = -1.0;
      if (cost >= least) continue;
      least = cost;
      best = v;
    }
    return best;
  }

  double worth(std::size_t v, Seat seat) {
    const Seat before = out_.parts[v].seat;
    out_.parts[v].seat = seat;
    double sum = params_.by_intention ? sight() : 0.0;
    out_.parts[v].seat = before;
    const SeatBid& b = bid(v, seat);
    sum -= params_.way_weight_per_s * b.way_s;
    if (seat == members_[v].seat) sum += params_.keep_weight;
    for (std::size_t other = 0; other < members_.size(); ++other)
      if (other != v && !out_.parts[other].seat.is_none())
        sum -= beside(seat, out_.parts[other].seat);
    return sum;
  }

  // What two seats cost each other.
  double beside(Seat a, Seat b) const {
    const double angle = std::abs(wrap_angle(a.bearing_rad() - b.bearing_rad()));
    const double spacing =
        (params_.by_intention ? params_.spacing_weight : 1.0) * 0.5 * (1.0 + std::cos(angle));
    const bool behind = a.sector() == b.sector();
    if (behind && a.ring() == b.ring()) return -kNever;
    const bool opposite = (a.sector() + kSeatSectors / 2) % kSeatSectors == b.sector();
    return spacing + (behind ? params_.occlusion_weight : 0.0) +
           (opposite ? params_.picture_weight : 0.0);
  }

  bool take_best(std::size_t v) {
    Seat best;
    double most = kNever / 2.0;
    for (int sector = 0; sector < kSeatSectors; ++sector) {
      const Seat seat = Seat::of(sector, ring_of(v));
      if (!bid(v, seat).possible()) continue;
      const double w = worth(v, seat);
      if (w <= most) continue;
      most = w;
      best = seat;
    }
    const bool changes = !(best == out_.parts[v].seat);
    out_.parts[v].seat = best;
    return changes;
  }

  std::span<const FleetMember> members_;
  const FleetParams& params_;
  FleetDivision& out_;
  std::size_t near_ = 0;
};

}  // namespace

const FleetPart* FleetDivision::part_of(std::string_view vehicle) const {
  for (const FleetPart& part : all())
    if (part.vehicle.view() == vehicle) return &part;
  return nullptr;
}

void agree_on_intentions(std::span<const FleetMember> members, FleetDivision& out) {
  const bool anybody =
      std::any_of(members.begin(), members.end(), std::mem_fn(&FleetMember::sees_followed));
  double sum = 0.0;
  for (const FleetMember& member : members) {
    if (anybody && !member.sees_followed()) continue;
    out.intention_count = std::max(out.intention_count, member.intention_count);
    for (int i = 0; i < member.intention_count; ++i) {
      out.intentions[i] += member.intentions[i];
      sum += member.intentions[i];
    }
  }
  if (sum > 0.0) {
    for (double& p : out.intentions) p /= sum;
    return;
  }
  out.intention_count = 1;
  out.intentions[0] = 1.0;
}

FleetDivision divide(std::span<const FleetMember> members, const FleetParams& params) {
  FleetDivision out;
  out.count = static_cast<int>(std::min<std::size_t>(members.size(), kFleetCapacity));
  members = members.first(out.count);
  agree_on_intentions(members, out);
  Dividing dividing(members, params, out);
  dividing.run();
  out.union_visibility = dividing.sight();
  for (int v = 0; v < out.count; ++v) {
    FleetPart& part = out.parts[v];
    part.vehicle = members[v].vehicle;
    part.ring = static_cast<std::size_t>(v) == dividing.near() ? SeatRing::kNear : SeatRing::kFar;
    if (!part.seat.is_none()) part.sees = members[v].bids[part.seat.number].sees;
  }
  return out;
}

}  // namespace foretrack
