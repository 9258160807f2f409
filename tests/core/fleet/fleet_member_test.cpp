// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_member.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

QuinticPiece line(const Vec3& from, const Vec3& velocity, double duration_s) {
  QuinticPiece piece;
  piece.duration_s = duration_s;
  piece.coefficients.row(0) = from.transpose();
  piece.coefficients.row(1) = velocity.transpose();
  return piece;
}

TEST(FleetPlan, IsFlownPieceByPieceAndThenStands) {
  FleetPlan plan;
  EXPECT_TRUE(plan.empty());
  plan.start_s = 10.0;
  plan.pieces[plan.count++] = line({0, 0, 1}, {1, 0, 0}, 2.0);
  plan.pieces[plan.count++] = line({2, 0, 1}, {0, 1, 0}, 1.0);
  EXPECT_TRUE(plan.position(9.0).isApprox(Vec3(0, 0, 1)));
  EXPECT_TRUE(plan.position(11.0).isApprox(Vec3(1, 0, 1)));
  EXPECT_TRUE(plan.position(12.5).isApprox(Vec3(2, 0.5, 1)));
  EXPECT_TRUE(plan.position(99.0).isApprox(Vec3(2, 1, 1)));
}

TEST(FleetMember, KnowsWhomItFollows) {
  FleetMember member;
  EXPECT_EQ(member.followed(), nullptr);
  member.person_count = 2;
  member.persons[0].id = 4;
  member.persons[1].id = 7;
  member.follows = 7;
  ASSERT_NE(member.followed(), nullptr);
  EXPECT_EQ(member.followed()->id, 7U);
  member.follows = 5;
  EXPECT_EQ(member.followed(), nullptr);
}

TEST(Seat, IsASectorInARing) {
  EXPECT_TRUE(Seat{}.is_none());
  for (int sector = 0; sector < kSeatSectors; ++sector)
    for (const SeatRing ring : {SeatRing::kNear, SeatRing::kFar}) {
      const Seat seat = Seat::of(sector, ring);
      EXPECT_FALSE(seat.is_none());
      EXPECT_EQ(seat.sector(), sector);
      EXPECT_EQ(seat.ring(), ring);
    }
  EXPECT_NEAR(Seat::of(3, SeatRing::kFar).bearing_rad(), 0.5 * kPi, 1e-12);
}

}  // namespace
}  // namespace foretrack
