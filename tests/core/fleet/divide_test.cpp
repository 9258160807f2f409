// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/divide.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr int kForward = 0, kLeft = 1, kRight = 2;

FleetMember member(const std::string& name, double x_m) {
  FleetMember m;
  m.vehicle = name;
  m.flies = true;
  m.position_enu_m = {x_m, 0, 1.5};
  m.follows = 1;
  m.person_count = 1;
  m.persons[0].id = 1;
  m.persons[0].status = TrackStatus::kTracking;
  m.persons[0].in_sight = true;
  m.intention_count = 3;
  m.intentions = {1.0, 0.0, 0.0};
  return m;
}

void can(FleetMember& m, int sector, SeatRing ring, double way_s,
         const std::array<float, 3>& sees) {
  SeatBid& bid = m.bids[Seat::of(sector, ring).number];
  bid.way_s = static_cast<float>(way_s);
  std::copy(sees.begin(), sees.end(), bid.sees.begin());
}

void can_all(FleetMember& m) {
  for (int sector = 0; sector < kSeatSectors; ++sector)
    for (const SeatRing ring : {SeatRing::kNear, SeatRing::kFar})
      can(m, sector, ring, 1.0, {1.0F, 1.0F, 1.0F});
}

TEST(Divide, OneIsNearAndTheOthersStandBehind) {
  std::vector<FleetMember> members = {member("a", 4.0), member("b", 2.0), member("c", 6.0)};
  for (FleetMember& m : members) can_all(m);
  const FleetDivision division = divide(members, {});
  ASSERT_EQ(division.count, 3);
  EXPECT_EQ(division.part_of("a")->ring, SeatRing::kFar);
  EXPECT_EQ(division.part_of("b")->ring, SeatRing::kNear) << "the nearest";
  EXPECT_EQ(division.part_of("c")->ring, SeatRing::kFar);
  EXPECT_EQ(division.part_of("d"), nullptr);
  EXPECT_GT(division.union_visibility, 0.95);
}

TEST(Divide, WhoIsNearStaysNearForAsLongAsTheyKnowThePerson) {
  std::vector<FleetMember> members = {member("a", 4.0), member("b", 2.0)};
  for (FleetMember& m : members) can_all(m);
  members[0].is_near = true;
  EXPECT_EQ(divide(members, {}).part_of("a")->ring, SeatRing::kNear);
  members[0].persons[0].status = TrackStatus::kLost;
  members[0].persons[0].in_sight = false;
  EXPECT_EQ(divide(members, {}).part_of("b")->ring, SeatRing::kNear);
}

// The one sees the person if they go on or turn left, and nobody sees them yet if they turn right.
TEST(Divide, TheSecondTakesTheSideThatTheFirstDoesNotSee) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0)};
  can(members[0], 6, SeatRing::kNear, 0.0, {1.0F, 1.0F, 0.0F});
  can(members[1], 5, SeatRing::kFar, 0.5, {1.0F, 1.0F, 0.0F});
  can(members[1], 7, SeatRing::kFar, 0.5, {0.6F, 0.0F, 1.0F});
  for (FleetMember& m : members) m.intentions = {0.4, 0.2, 0.4};
  const FleetDivision division = divide(members, {});
  EXPECT_EQ(division.part_of("a")->seat, Seat::of(6, SeatRing::kNear));
  EXPECT_EQ(division.part_of("b")->seat, Seat::of(7, SeatRing::kFar));
  EXPECT_GT(division.union_visibility, 0.85);
}

TEST(Divide, WithoutIntentionsTheyStandEvenly) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0), member("c", 4.0)};
  for (FleetMember& m : members) can_all(m);
  FleetParams params;
  params.by_intention = false;
  const FleetDivision division = divide(members, params);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < i; ++k)
      EXPECT_GT(std::abs(wrap_angle(division.parts[i].seat.bearing_rad() -
                                    division.parts[k].seat.bearing_rad())),
                rad(85.0));
}

TEST(Divide, NobodyStandsInAnothersLineOfSight) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0)};
  for (FleetMember& m : members) can_all(m);
  const FleetDivision division = divide(members, {});
  EXPECT_NE(division.parts[0].seat.sector(), division.parts[1].seat.sector());
}

TEST(Divide, ASeatThatNobodyCanTakeIsNoSeat) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0)};
  can(members[0], 6, SeatRing::kNear, 0.0, {1.0F, 1.0F, 1.0F});
  const FleetDivision division = divide(members, {});
  EXPECT_FALSE(division.part_of("a")->seat.is_none());
  EXPECT_TRUE(division.part_of("b")->seat.is_none());
}

TEST(Divide, ItsResultHeldIsItsResult) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0), member("c", 5.0)};
  for (FleetMember& m : members) can_all(m);
  can(members[2], 1, SeatRing::kFar, 0.2, {0.3F, 0.9F, 1.0F});
  const FleetDivision once = divide(members, {});
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].seat = once.parts[i].seat;
    members[i].is_near = once.parts[i].ring == SeatRing::kNear;
  }
  const FleetDivision again = divide(members, {});
  for (std::size_t i = 0; i < members.size(); ++i)
    EXPECT_EQ(again.parts[i].seat, once.parts[i].seat);
}

TEST(AgreeOnIntentions, ThoseWhoSeeThePersonSay) {
  std::vector<FleetMember> members = {member("a", 2.0), member("b", 3.0)};
  members[0].intentions = {0.2, 0.8, 0.0};
  members[1].intentions = {1.0, 0.0, 0.0};
  members[1].persons[0].in_sight = false;
  FleetDivision division;
  agree_on_intentions(members, division);
  EXPECT_NEAR(division.intentions[kForward], 0.2, 1e-9);
  EXPECT_NEAR(division.intentions[kLeft], 0.8, 1e-9);
  EXPECT_NEAR(division.intentions[kRight], 0.0, 1e-9);
}

TEST(AgreeOnIntentions, WithoutAWordThePersonGoesOn) {
  FleetMember silent;
  FleetDivision division;
  agree_on_intentions({&silent, 1}, division);
  EXPECT_EQ(division.intention_count, 1);
  EXPECT_EQ(division.intentions[0], 1.0);
}

}  // namespace
}  // namespace foretrack
