// SPDX-License-Identifier: Apache-2.0
#include "services/convert/fleet.hpp"

#include "convert_test_support.hpp"
#include "core/prediction/intentions/intention_table.hpp"
#include "services/common/raw.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using MemberMsg = foretrack_msgs::msg::FleetMember;

FleetPlan straight_plan(int pieces) {
  FleetPlan plan;
  plan.start_s = 7.5;
  for (int i = 0; i < pieces; ++i) {
    QuinticPiece& piece = plan.pieces[plan.count++];
    piece.duration_s = 0.5;
    piece.coefficients.row(0) << 1.0 + 0.5 * i, 2.0, 1.5;
    piece.coefficients.row(1) << 1.0, 0.0, 0.0;
  }
  return plan;
}

FleetMember member(int pieces = 6) {
  FleetMember m;
  m.vehicle = "uav2";
  m.frame = "map";
  m.stamp_s = 7.25;
  m.sequence_number = 41;
  m.flies = true;
  m.position_enu_m = {1, 2, 1.5};
  m.velocity_enu_m_s = {0.5, -0.25, 0};
  m.yaw_rad = 0.5;
  m.radius_m = 0.25;
  m.battery = 0.75;
  m.plan = straight_plan(pieces);
  m.follows = 3;
  m.person_count = 1;
  m.persons[0] = {.id = 3,
                  .status = TrackStatus::kTracking,
                  .in_sight = true,
                  .position_enu_m = {4, 5, 1.1},
                  .velocity_enu_m_s = {1.5, 0, 0},
                  .covariance = 0.25 * Mat6::Identity()};
  m.intention_count = kIntentionCount;
  m.intentions[0] = 0.75;
  m.intentions[2] = 0.25;
  m.seat = Seat::of(7, SeatRing::kFar);
  m.is_near = false;
  m.bids[5].way_s = 2.34F;
  m.bids[5].sees[2] = 0.5F;
  m.bids[23].way_s = 25.4F;
  for (SeatBid& bid : m.bids) bid = as_told(bid);
  return m;
}

MemberMsg message() {
  MemberMsg out;
  to_idl(member(), out);
  return out;
}

TEST(FleetMemberMessage, RoundTrips) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  const FleetMember in = member();
  EXPECT_EQ(out->vehicle, in.vehicle);
  EXPECT_EQ(out->frame, in.frame);
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->sequence_number, in.sequence_number);
  EXPECT_EQ(out->flies, in.flies);
  EXPECT_EQ(out->position_enu_m, in.position_enu_m);
  EXPECT_EQ(out->velocity_enu_m_s, in.velocity_enu_m_s);
  EXPECT_EQ(out->yaw_rad, in.yaw_rad);
  EXPECT_EQ(out->radius_m, in.radius_m);
  EXPECT_EQ(out->battery, in.battery);
  EXPECT_EQ(out->follows, in.follows);
  ASSERT_TRUE(out->followed());
  EXPECT_EQ(out->followed()->position_enu_m, in.followed()->position_enu_m);
  EXPECT_EQ(out->followed()->covariance, in.followed()->covariance);
  EXPECT_TRUE(out->followed()->in_sight);
  EXPECT_EQ(out->intentions, in.intentions);
  EXPECT_EQ(out->intention_count, in.intention_count);
  EXPECT_EQ(out->seat, in.seat);
  EXPECT_EQ(out->is_near, in.is_near);
}

TEST(FleetMemberMessage, ThePlanIsFlownAlikeByWhoHearsIt) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out);
  ASSERT_EQ(out->plan.count, 6);
  for (double t_s = 7.0; t_s < 11.0; t_s += 0.1)
    EXPECT_LT((out->plan.position(t_s) - member().plan.position(t_s)).norm(), 1e-5);
}

TEST(FleetMemberMessage, BidsComeAsTheyWereTold) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out);
  for (int seat = 0; seat < kSeatCount; ++seat) {
    EXPECT_EQ(out->bids[seat].way_s, member().bids[seat].way_s) << seat;
    EXPECT_EQ(out->bids[seat].possible(), member().bids[seat].possible()) << seat;
    EXPECT_EQ(out->bids[seat].sees, member().bids[seat].sees) << seat;
  }
  EXPECT_TRUE(out->bids[23].possible());
  EXPECT_FALSE(out->bids[0].possible());
}

TEST(FleetMemberMessage, OfIntentionsThatAreNotKnownHereNothingIsKept) {
  MemberMsg m = message();
  m.intentions()[2].name("climb_a_tree");
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->intentions[0], 0.75);
  EXPECT_EQ(out->intentions[2], 0.0);
  EXPECT_EQ(out->bids[5].sees[2], 0.0F);
}

TEST(FleetMemberMessage, IntentionsInAnotherOrderAreTheSameOnes) {
  MemberMsg m = message();
  std::swap(m.intentions()[0], m.intentions()[2]);
  for (int seat = 0; seat < kSeatCount; ++seat)
    std::swap(m.seat_sees()[seat * kIntentionCount], m.seat_sees()[seat * kIntentionCount + 2]);
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->intentions, member().intentions);
  EXPECT_EQ(out->bids[5].sees, member().bids[5].sees);
}

TEST(FleetMemberMessage, AUsualPlanFitsTheRadio) {
  MemberMsg full;
  to_idl(member(FleetPlan::kMaxPieces), full);
  MemberMsg usual = message();
  const auto bytes = [](const MemberMsg& m) { return to_cdr(type_ops<MemberMsg>(), &m).size(); };
  EXPECT_LE(bytes(usual), 1500u);
  EXPECT_LE(bytes(full), 2500u);
}

TEST(FleetMemberMessage, RefusesEachBadField) {
  using M = MemberMsg;
  testing::expect_each_refused<M>(
      message(),
      {{"header.stamp", [](M& m) { m.header().stamp().sec(-1); }},
       {"header.frame_id", [](M& m) { m.header().frame_id(""); }},
       {"header.frame_id", [](M& m) { m.header().frame_id(std::string(65, 'x')); }},
       {"vehicle", [](M& m) { m.vehicle(""); }},
       {"position_m", [](M& m) { m.position_m()[1] = kNaN; }},
       {"position_m", [](M& m) { m.position_m()[1] = 1e6; }},
       {"velocity_mps", [](M& m) { m.velocity_mps()[0] = 300.0F; }},
       {"yaw_rad", [](M& m) { m.yaw_rad(kInf); }},
       {"radius_m", [](M& m) { m.radius_m(0.0F); }},
       {"battery", [](M& m) { m.battery(1.5F); }},
       {"seat", [](M& m) { m.seat(24); }},
       {"seat", [](M& m) { m.seat(-2); }},
       {"plan_start", [](M& m) { m.plan_start().nanosec(1'000'000'000u); }},
       {"plan", [](M& m) { m.plan().resize(17); }},
       {"plan.duration_s", [](M& m) { m.plan()[1].duration_s(0.0F); }},
       {"plan.start_m", [](M& m) { m.plan()[1].start_m()[0] = kNaN; }},
       {"plan.coefficients", [](M& m) { m.plan()[1].coefficients()[4][2] = kNaN; }},
       {"pieces.velocity", [](M& m) { m.plan()[1].coefficients()[0][2] = 300.0F; }},
       {"pieces.position jump", [](M& m) { m.plan()[1].start_m()[0] += 0.5; }},
       {"persons", [](M& m) { m.persons().resize(5); }},
       {"persons.person_id", [](M& m) { m.persons()[0].person_id(0); }},
       {"persons.person_id", [](M& m) { m.persons().push_back(m.persons()[0]); }},
       {"persons.status", [](M& m) { m.persons()[0].status(4); }},
       {"persons.position_m", [](M& m) { m.persons()[0].position_m()[2] = kNaN; }},
       {"persons.velocity_mps", [](M& m) { m.persons()[0].velocity_mps()[2] = 201.0F; }},
       {"persons.covariance", [](M& m) { m.persons()[0].covariance()[0] = -1.0F; }},
       {"follows", [](M& m) { m.follows(9); }},
       {"intentions", [](M& m) { m.intentions().resize(17); }},
       {"intentions.probability", [](M& m) { m.intentions()[0].probability(1.5F); }},
       {"intentions.probability", [](M& m) { m.intentions()[1].probability(0.5F); }},
       {"intentions.name", [](M& m) { m.intentions()[1].name(m.intentions()[0].name()); }},
       {"seat_sees", [](M& m) { m.seat_sees().pop_back(); }}},
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
