// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/use_fleet.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TargetState target(TrackStatus status, double stamp_s) {
  TargetState out;
  out.status = status;
  out.stamp_s = stamp_s;
  return out;
}

TEST(SeenByAny, WhoSeesGoesByItsOwnEyes) {
  const TargetState own = target(TrackStatus::kTracking, 9.9);
  const TargetState told = target(TrackStatus::kTracking, 10.0);
  EXPECT_EQ(&seen_by_any(own, told, 10.0), &own);
}

TEST(SeenByAny, WhoDoesNotGoesByTheOthersAsLongAsTheySee) {
  const TargetState own = target(TrackStatus::kLost, 10.0);
  const TargetState told = target(TrackStatus::kTracking, 10.0);
  EXPECT_EQ(&seen_by_any(own, told, 10.1), &told);
  EXPECT_EQ(&seen_by_any(own, told, 10.6), &own) << "it is an old word";
  const TargetState unseen = target(TrackStatus::kCoasting, 10.0);
  EXPECT_EQ(&seen_by_any(own, unseen, 10.0), &own);
}

SeatPlace place(SeatRing ring) {
  return {.is_alone = false,
          .ring = ring,
          .seat = Seat::of(3, ring),
          .bearing_rad = 1.5,
          .distance_m = 3.5};
}

TEST(FramingOfAFleet, TheNearOneKeepsItsDistanceTheOthersTakeTheirs) {
  const Framing near = framing_of({}, place(SeatRing::kNear), {});
  EXPECT_TRUE(std::isnan(near.distance_m));
  EXPECT_EQ(near.bearing_enu_rad, 1.5);
  EXPECT_TRUE(near.is_seat);
  EXPECT_EQ(framing_of({}, place(SeatRing::kFar), {}).distance_m, 3.5);
}

TEST(FramingOfAFleet, ALayerIsAHeight) {
  SeatPlace place;
  place.is_alone = false;
  place.ring = SeatRing::kFar;
  EXPECT_TRUE(std::isnan(framing_of({}, place, {}).height_m)) << "as usual";
  place.height_m = 2.4;
  EXPECT_EQ(framing_of({}, place, {}).height_m, 2.4);
}

TEST(FramingOfAFleet, AnOperatorsOrderComesFirst) {
  Framing ordered;
  ordered.height_m = 1.0;
  EXPECT_EQ(framing_of(ordered, place(SeatRing::kFar), {}), ordered);
}

TEST(FramingOfAFleet, AloneNothingIsWanted) {
  EXPECT_TRUE(framing_of({}, SeatPlace{}, {}).is_free());
  SeatPlace anywhere = place(SeatRing::kNear);
  anywhere.seat = {};
  EXPECT_TRUE(framing_of({}, anywhere, {}).is_free());
}

TEST(AllOf, PeersAreBodiesAsLongAsTheyAreHeard) {
  MovingBodies around, peers;
  around.stamp_s = peers.stamp_s = 10.0;
  around.add({});
  peers.add({});
  EXPECT_EQ(all_of(around, peers, 10.5).count, 2);
  EXPECT_EQ(all_of(around, peers, 11.5).count, 1);
  EXPECT_EQ(all_of(around, {}, 10.0).count, 1);
}

TEST(AsTold, RoundsToWhatAMessageCarries) {
  SeatBid bid;
  bid.way_s = 1.234F;
  bid.sees[2] = 0.5F;
  const SeatBid told = as_told(bid);
  EXPECT_NEAR(told.way_s, 1.2, 1e-6);
  EXPECT_NEAR(told.sees[2], 128.0 / 255.0, 1e-6);
  EXPECT_EQ(as_told(told).sees, told.sees);
  EXPECT_FALSE(as_told(SeatBid{}).possible());
  bid.way_s = 25.49F;
  EXPECT_TRUE(as_told(bid).possible()) << "what is possible stays so";
}

}  // namespace
}  // namespace foretrack
