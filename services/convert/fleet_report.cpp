// SPDX-License-Identifier: Apache-2.0
#include "services/convert/fleet_report.hpp"

#include <algorithm>

#include "services/convert/fleet_names.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
namespace trusts = msg::FleetPeer_Constants;
static_assert(trusts::TRUST_OWN == int(FleetTrust::kOwn));
static_assert(trusts::TRUST_COMMON == int(FleetTrust::kCommon));
static_assert(trusts::TRUST_ALIGNED == int(FleetTrust::kAligned));
static_assert(trusts::TRUST_UNALIGNED == int(FleetTrust::kUnaligned));
static_assert(trusts::TRUST_LIAR == int(FleetTrust::kLiar));

constexpr double kMostAge_s = 1e6;

void write_parts(const FleetDivision& in, msg::FleetDivision& out) {
  out.seats().resize(static_cast<std::size_t>(in.count));
  for (int i = 0; i < in.count; ++i) {
    const FleetPart& part = in.parts[i];
    auto& row = out.seats()[i];
    row.vehicle(std::string(part.vehicle.view()));
    row.seat(part.seat.number);
    row.is_near(part.ring == SeatRing::kNear);
    row.sees().resize(out.intentions().size());
    for (std::size_t k = 0; k < row.sees().size(); ++k)
      row.sees()[k] = part.sees[index_of(kIntentions[k].id)];
  }
}

void read_parts(Checks& checks, const msg::FleetDivision& in, const FleetPlaces& told,
                FleetDivision& out) {
  checks.count("seats", in.seats().size(), 0, kFleetCapacity);
  if (!checks.ok()) return;
  for (const auto& row : in.seats()) {
    FleetPart& part = out.parts[out.count++];
    check_vehicle(checks, row.vehicle().c_str());
    check_seat(checks, row.seat());
    checks.count("seats.sees", row.sees().size(), told.count, told.count);
    if (!checks.ok()) return;
    part.vehicle = std::string_view(row.vehicle().c_str());
    part.seat.number = row.seat();
    part.ring = row.is_near() ? SeatRing::kNear : SeatRing::kFar;
    for (int k = 0; k < told.count; ++k) {
      checks.in_range("seats.sees", row.sees()[k], 0.0, 1.0);
      if (told.places[k] >= 0) part.sees[told.places[k]] = row.sees()[k];
    }
  }
}

void read_peers(Checks& checks, const msg::FleetDivision& in, FleetReport& out) {
  checks.count("peers", in.peers().size(), 0, out.peers.size());
  if (!checks.ok()) return;
  for (const auto& row : in.peers()) {
    check_vehicle(checks, row.vehicle().c_str());
    checks.enumerator("peers.trust", row.trust(), trusts::TRUST_LIAR);
    checks.in_range("peers.age_s", row.age_s(), 0.0, kMostAge_s);
    checks.within("peers.position_m", row.position_m(), limits::kPosition_m);
    checks.within("peers.separation_m", row.separation_m(), 2.0 * limits::kPosition_m);
    if (!checks.ok()) return;
    out.peers[out.peer_count++] = {std::string_view(row.vehicle().c_str()),
                                   static_cast<FleetTrust>(row.trust()), row.age_s(),
                                   to_vec3(row.position_m()), row.separation_m()};
  }
}

}  // namespace

FleetReport report_of(const FleetState& state, const FleetResult& result) {
  const FleetMember& own = result.message;
  FleetReport out{.stamp_s = own.stamp_s,
                  .vehicle = own.vehicle,
                  .place = result.place,
                  .division = result.division,
                  .separation_m = result.separation_m};
  for (const FleetPeer& peer : state.all())
    out.peers[out.peer_count++] = {
        peer.told.vehicle, peer.trust, std::max(own.stamp_s - peer.told.stamp_s, 0.0),
        peer.ours.position_enu_m,
        (peer.ours.position_enu_m - own.position_enu_m).norm() - own.radius_m - peer.ours.radius_m};
  return out;
}

void to_idl(const FleetReport& in, msg::FleetDivision& out) {
  set_header(out.header(), in.stamp_s);
  out.vehicle(std::string(in.vehicle.view()));
  out.is_alone(in.place.is_alone);
  out.seat(in.place.seat.number);
  out.is_near(in.place.ring == SeatRing::kNear);
  out.bearing_rad(in.place.bearing_rad);
  out.distance_m(in.place.distance_m);
  out.height_m(in.place.height_m);
  write_intentions(in.division.intentions, in.division.intention_count, out.intentions());
  write_parts(in.division, out);
  out.union_visibility(in.division.union_visibility);
  out.separation_m(std::clamp(in.separation_m, -limits::kPosition_m, limits::kPosition_m));
  out.peers().resize(static_cast<std::size_t>(in.peer_count));
  for (int i = 0; i < in.peer_count; ++i) {
    auto& row = out.peers()[i];
    row.vehicle(std::string(in.peers[i].vehicle.view()));
    row.trust(static_cast<std::uint8_t>(in.peers[i].trust));
    row.age_s(in.peers[i].age_s);
    row.position_m(to_array(in.peers[i].position_enu_m));
    row.separation_m(in.peers[i].separation_m);
  }
}

Converted<FleetReport> from_idl(const msg::FleetDivision& in) {
  Checks checks;
  FleetReport out;
  check_header(checks, in.header());
  check_vehicle(checks, in.vehicle().c_str());
  check_seat(checks, in.seat());
  checks.within("bearing_rad", in.bearing_rad(), limits::kAngle_rad);
  checks.in_range("distance_m", in.distance_m(), 0.0, limits::kPosition_m);
  checks.in_range("height_m", in.height_m(), 0.0, limits::kPosition_m);
  checks.in_range("union_visibility", in.union_visibility(), 0.0, 1.0 + limits::kSumTolerance);
  checks.within("separation_m", in.separation_m(), limits::kPosition_m);
  const FleetPlaces told = read_intentions(checks, in.intentions(), out.division.intentions,
                                           out.division.intention_count);
  read_parts(checks, in, told, out.division);
  read_peers(checks, in, out);
  if (!checks.ok()) return checks.result(out);
  out.stamp_s = seconds(in.header().stamp());
  out.vehicle = std::string_view(in.vehicle().c_str());
  out.place.is_alone = in.is_alone();
  out.place.seat.number = in.seat();
  out.place.ring = in.is_near() ? SeatRing::kNear : SeatRing::kFar;
  out.place.bearing_rad = in.bearing_rad();
  out.place.distance_m = in.distance_m();
  out.place.height_m = in.height_m();
  out.division.union_visibility = in.union_visibility();
  out.separation_m = in.separation_m();
  return checks.result(out);
}

}  // namespace foretrack
