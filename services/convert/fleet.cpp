// SPDX-License-Identifier: Apache-2.0
#include "services/convert/fleet.hpp"

#include <algorithm>
#include <cmath>

#include "services/convert/fleet_names.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/pieces.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
constexpr std::size_t kMostFrame = 64;
constexpr double kMostRadius_m = 20.0;
constexpr int kCannot_ds = 255;
constexpr double kShares = 255.0;

void write_plan(const FleetPlan& in, msg::FleetMember& out) {
  out.plan_start(to_time(in.start_s));
  out.plan().resize(static_cast<std::size_t>(in.count));
  for (int i = 0; i < in.count; ++i) {
    const QuinticPiece& piece = in.pieces[i];
    auto& row = out.plan()[i];
    row.duration_s(static_cast<float>(piece.duration_s));
    row.start_m(to_array(piece.coefficients.row(0)));
    for (int power = 1; power < 6; ++power)
      row.coefficients()[power - 1] = to_floats(piece.coefficients.row(power));
  }
}

QuinticPiece read_fleet_piece(Checks& checks, const msg::FleetPiece& in) {
  QuinticPiece out;
  checks.positive("plan.duration_s", in.duration_s(), limits::kDuration_s);
  checks.within("plan.start_m", in.start_m(), limits::kPosition_m);
  out.duration_s = in.duration_s();
  out.coefficients.row(0) = to_vec3(in.start_m());
  for (int power = 1; power < 6; ++power) {
    checks.within("plan.coefficients", in.coefficients()[power - 1], 1e9);
    out.coefficients.row(power) = to_vec3(in.coefficients()[power - 1]);
  }
  check_ends(checks, out);
  return out;
}

void read_plan(Checks& checks, const msg::FleetMember& in, FleetPlan& out) {
  checks.stamp("plan_start", in.plan_start());
  checks.count("plan", in.plan().size(), 0, FleetPlan::kMaxPieces);
  if (!checks.ok()) return;
  out.start_s = seconds(in.plan_start());
  for (const auto& piece : in.plan()) {
    out.pieces[out.count++] = read_fleet_piece(checks, piece);
    if (out.count > 1) check_join(checks, out.pieces[out.count - 2], out.pieces[out.count - 1]);
  }
}

void write_person(const FleetPerson& in, msg::FleetPerson& out) {
  out.person_id(in.id);
  out.status(static_cast<std::uint8_t>(in.status));
  out.in_sight(in.in_sight);
  out.position_m(to_array(in.position_enu_m));
  out.velocity_mps(to_floats(in.velocity_enu_m_s));
  for (int i = 0; i < 36; ++i)
    out.covariance()[i] = static_cast<float>(in.covariance(i / 6, i % 6));
}

FleetPerson read_person(Checks& checks, const msg::FleetPerson& in) {
  std::array<double, 36> covariance{};
  std::ranges::copy(in.covariance(), covariance.begin());
  checks.in_range("persons.person_id", in.person_id(), 1.0, 4294967295.0);
  checks.enumerator("persons.status", in.status(), unsigned(TrackStatus::kLost));
  checks.within("persons.position_m", in.position_m(), limits::kPosition_m);
  checks.within("persons.velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  checks.covariance("persons.covariance", covariance.data(), 6);
  return {.id = in.person_id(),
          .status = static_cast<TrackStatus>(in.status()),
          .in_sight = in.in_sight(),
          .position_enu_m = to_vec3(in.position_m()),
          .velocity_enu_m_s = to_vec3(in.velocity_mps()),
          .covariance = from_rows<6>(covariance)};
}

void read_persons(Checks& checks, const msg::FleetMember& in, FleetMember& out) {
  checks.count("persons", in.persons().size(), 0, FleetMember::kMaxPersons);
  if (!checks.ok()) return;
  for (const auto& person : in.persons()) {
    for (const FleetPerson& other : out.all_persons())
      if (other.id == person.person_id())
        checks.fail("persons.person_id", std::to_string(other.id), "each only once");
    out.persons[out.person_count++] = read_person(checks, person);
  }
  out.follows = in.follows();
  if (out.follows != 0 && !out.followed())
    checks.fail("follows", std::to_string(out.follows), "one of the persons, or 0");
}

void write_bids(const FleetMember& in, msg::FleetMember& out) {
  const std::size_t intentions = out.intentions().size();
  out.seat_sees().resize(kSeatCount * intentions);
  for (int seat = 0; seat < kSeatCount; ++seat) {
    const SeatBid& bid = in.bids[seat];
    const auto way_ds = static_cast<int>(std::lround(10.0F * bid.way_s));
    out.seat_way_ds()[seat] = static_cast<std::uint8_t>(std::clamp(way_ds, 0, kCannot_ds));
    for (std::size_t i = 0; i < intentions; ++i)
      out.seat_sees()[seat * intentions + i] =
          static_cast<std::uint8_t>(std::lround(kShares * bid.sees[index_of(kIntentions[i].id)]));
  }
}

void read_bids(Checks& checks, const msg::FleetMember& in, const FleetPlaces& told,
               FleetMember& out) {
  const std::size_t shares = static_cast<std::size_t>(kSeatCount) * told.count;
  checks.count("seat_sees", in.seat_sees().size(), shares, shares);
  if (!checks.ok()) return;
  for (int seat = 0; seat < kSeatCount; ++seat) {
    SeatBid& bid = out.bids[seat];
    bid.way_s = static_cast<float>(in.seat_way_ds()[seat]) / 10.0F;
    for (int i = 0; i < told.count; ++i)
      if (told.places[i] >= 0)
        bid.sees[told.places[i]] = in.seat_sees()[seat * told.count + i] / 255.0F;
  }
}

}  // namespace

void to_idl(const FleetMember& in, msg::FleetMember& out) {
  set_header(out.header(), in.stamp_s, in.frame.view());
  out.vehicle(std::string(in.vehicle.view()));
  out.sequence_number(in.sequence_number);
  out.flies(in.flies);
  out.position_m(to_array(in.position_enu_m));
  out.velocity_mps(to_floats(in.velocity_enu_m_s));
  out.yaw_rad(static_cast<float>(in.yaw_rad));
  out.radius_m(static_cast<float>(in.radius_m));
  out.battery(static_cast<float>(in.battery));
  write_plan(in.plan, out);
  out.follows(in.follows);
  out.persons().resize(static_cast<std::size_t>(in.person_count));
  for (int i = 0; i < in.person_count; ++i) write_person(in.persons[i], out.persons()[i]);
  write_intentions(in.intentions, in.intention_count, out.intentions());
  out.seat(in.seat.number);
  out.is_near(in.is_near);
  write_bids(in, out);
}

Converted<FleetMember> from_idl(const msg::FleetMember& in) {
  Checks checks;
  FleetMember out;
  checks.stamp("header.stamp", in.header().stamp());
  checks.count("header.frame_id", in.header().frame_id().size(), 1, kMostFrame);
  check_vehicle(checks, in.vehicle().c_str());
  checks.within("position_m", in.position_m(), limits::kPosition_m);
  checks.within("velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  checks.within("yaw_rad", in.yaw_rad(), limits::kAngle_rad);
  checks.positive("radius_m", in.radius_m(), kMostRadius_m);
  checks.in_range("battery", in.battery(), -1.0, 1.0);
  check_seat(checks, in.seat());
  read_plan(checks, in, out.plan);
  read_persons(checks, in, out);
  const FleetPlaces told =
      read_intentions(checks, in.intentions(), out.intentions, out.intention_count);
  read_bids(checks, in, told, out);
  if (!checks.ok()) return checks.result(out);
  out.vehicle = std::string_view(in.vehicle().c_str());
  out.frame = std::string_view(in.header().frame_id());
  out.stamp_s = seconds(in.header().stamp());
  out.sequence_number = in.sequence_number();
  out.flies = in.flies();
  out.position_enu_m = to_vec3(in.position_m());
  out.velocity_enu_m_s = to_vec3(in.velocity_mps());
  out.yaw_rad = in.yaw_rad();
  out.radius_m = in.radius_m();
  out.battery = in.battery();
  out.seat.number = in.seat();
  out.is_near = in.is_near();
  return checks.result(out);
}

}  // namespace foretrack
