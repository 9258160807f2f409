// SPDX-License-Identifier: Apache-2.0
#include "services/convert/fleet_report.hpp"

#include "convert_test_support.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {
namespace {

using testing::kNaN;
using DivisionMsg = foretrack_msgs::msg::FleetDivision;

FleetReport report() {
  FleetReport r;
  r.stamp_s = 7.25;
  r.vehicle = "uav1";
  r.place = {.is_alone = false,
             .ring = SeatRing::kFar,
             .seat = Seat::of(3, SeatRing::kFar),
             .bearing_rad = 1.5,
             .distance_m = 3.5};
  r.separation_m = 1.75;
  FleetDivision& d = r.division;
  d.count = 2;
  d.parts[0] = {.vehicle = "uav1", .ring = SeatRing::kFar, .seat = r.place.seat};
  d.parts[0].sees[1] = 0.5F;
  d.parts[1] = {.vehicle = "uav2", .ring = SeatRing::kNear, .seat = {}};
  d.intention_count = kIntentionCount;
  d.intentions[1] = 0.5;
  d.union_visibility = 0.75;
  r.peer_count = 1;
  r.peers[0] = {"uav2", FleetTrust::kAligned, 0.25, {1, 2, 3}, 1.75};
  return r;
}

DivisionMsg message() {
  DivisionMsg out;
  to_idl(report(), out);
  return out;
}

TEST(FleetDivisionMessage, RoundTrips) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  const FleetReport in = report();
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->vehicle, in.vehicle);
  EXPECT_EQ(out->place.is_alone, in.place.is_alone);
  EXPECT_EQ(out->place.ring, in.place.ring);
  EXPECT_EQ(out->place.seat, in.place.seat);
  EXPECT_EQ(out->place.bearing_rad, in.place.bearing_rad);
  EXPECT_EQ(out->place.distance_m, in.place.distance_m);
  ASSERT_EQ(out->division.count, 2);
  const FleetPart* part = out->division.part_of("uav1");
  ASSERT_TRUE(part);
  EXPECT_EQ(part->seat, in.place.seat);
  EXPECT_EQ(part->ring, SeatRing::kFar);
  EXPECT_EQ(part->sees, in.division.parts[0].sees);
  EXPECT_TRUE(out->division.part_of("uav2")->seat.is_none());
  EXPECT_EQ(out->division.intentions, in.division.intentions);
  EXPECT_EQ(out->division.union_visibility, in.division.union_visibility);
  EXPECT_EQ(out->separation_m, in.separation_m);
  ASSERT_EQ(out->peer_count, 1);
  EXPECT_EQ(out->peers[0].vehicle, in.peers[0].vehicle);
  EXPECT_EQ(out->peers[0].trust, in.peers[0].trust);
  EXPECT_EQ(out->peers[0].age_s, in.peers[0].age_s);
  EXPECT_EQ(out->peers[0].position_enu_m, in.peers[0].position_enu_m);
}

TEST(FleetDivisionMessage, TellsOfWhoIsAloneWithoutAnInfiniteSeparation) {
  DivisionMsg out;
  to_idl(FleetReport{.stamp_s = 1.0,
                     .vehicle = "uav1",
                     .place = {},
                     .division = {},
                     .separation_m = std::numeric_limits<double>::infinity()},
         out);
  const auto in = from_idl(out);
  ASSERT_TRUE(in) << in.fault().text;
  EXPECT_TRUE(in->place.is_alone);
  EXPECT_GT(in->separation_m, 1e4);
}

TEST(FleetDivisionMessage, RefusesEachBadField) {
  using M = DivisionMsg;
  testing::expect_each_refused<M>(
      message(),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"vehicle", [](M& m) { m.vehicle(""); }},
              {"seat", [](M& m) { m.seat(24); }},
              {"bearing_rad", [](M& m) { m.bearing_rad(kNaN); }},
              {"distance_m", [](M& m) { m.distance_m(-1.0); }},
              {"union_visibility", [](M& m) { m.union_visibility(1.5); }},
              {"separation_m", [](M& m) { m.separation_m(kNaN); }},
              {"intentions.probability", [](M& m) { m.intentions()[0].probability(-0.5F); }},
              {"seats", [](M& m) { m.seats().resize(17); }},
              {"vehicle", [](M& m) { m.seats()[0].vehicle(""); }},
              {"seat", [](M& m) { m.seats()[0].seat(100); }},
              {"seats.sees", [](M& m) { m.seats()[0].sees().pop_back(); }},
              {"seats.sees", [](M& m) { m.seats()[0].sees()[0] = 2.0F; }},
              {"peers", [](M& m) { m.peers().resize(16); }},
              {"vehicle", [](M& m) { m.peers()[0].vehicle(""); }},
              {"peers.trust", [](M& m) { m.peers()[0].trust(5); }},
              {"peers.age_s", [](M& m) { m.peers()[0].age_s(-1.0); }},
              {"peers.position_m", [](M& m) { m.peers()[0].position_m()[0] = kNaN; }},
              {"peers.separation_m", [](M& m) { m.peers()[0].separation_m(kNaN); }}},
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
