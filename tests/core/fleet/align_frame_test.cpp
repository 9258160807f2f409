// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/align_frame.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kYaw_rad = 0.8;
const Vec3 kShift_m(12.0, -7.0, 0.4);

Vec3 theirs_of(const Vec3& ours) {
  return Eigen::AngleAxisd(-kYaw_rad, Vec3::UnitZ()) * (ours - kShift_m);
}

// A person walks round a block, and both see them with noise.
FrameAlignment after(double duration_s, double sigma_m, double speed_m_s = 1.5) {
  AlignmentSums sums;
  Random random(7);
  const FleetParams params;
  for (double t = 0.0; t < duration_s; t += 0.1) {
    const double way = speed_m_s * t, leg = std::fmod(way, 20.0);
    const Vec3 ours = leg < 10.0 ? Vec3(leg, 0.0, 1.0) : Vec3(10.0, leg - 10.0, 1.0);
    const auto noise = [&] {
      return Vec3(random.normal(0, sigma_m), random.normal(0, sigma_m), 0);
    };
    add_pair(sums, t, theirs_of(ours) + noise(), ours + noise(), params);
  }
  return align_frame(sums);
}

TEST(AlignFrame, FindsHowTheOtherFrameLies) {
  const FrameAlignment a = after(15.0, 0.1);
  EXPECT_NEAR(a.yaw_rad, kYaw_rad, 0.03);
  const Vec3 there(5.0, 3.0, 1.0);
  EXPECT_LT((a.place(theirs_of(there)) - there).norm(), 0.15);
  EXPECT_TRUE(a.is_sure({}));
}

TEST(AlignFrame, IsNotSureAtFirstNorWhileThePersonStands) {
  EXPECT_FALSE(align_frame({}).is_sure({}));
  EXPECT_FALSE(after(1.0, 0.1).is_sure({}));
  EXPECT_FALSE(after(15.0, 0.1, 0.0).is_sure({})) << "nobody can tell how it is turned";
}

TEST(AlignFrame, IsNotSureOfTwoWhoFollowTwoPeople) {
  AlignmentSums sums;
  for (double t = 0.0; t < 15.0; t += 0.1)
    add_pair(sums, t, Vec3(1.5 * t, 0.0, 1.0),
             Vec3(8.0 * std::sin(t), 8.0 * std::cos(2.0 * t), 1.0), {});
  EXPECT_FALSE(align_frame(sums).is_sure({}));
}

TEST(AlignFrame, SigmasHoldWhatTheErrorsAre) {
  int held = 0, runs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    AlignmentSums sums;
    Random random(seed);
    for (double t = 0.0; t < 12.0; t += 0.1) {
      const Vec3 ours(1.5 * t, 4.0 * std::sin(0.5 * t), 1.0);
      const auto noise = [&] { return Vec3(random.normal(0, 0.1), random.normal(0, 0.1), 0); };
      add_pair(sums, t, theirs_of(ours) + noise(), ours + noise(), {});
    }
    const FrameAlignment a = align_frame(sums);
    ++runs;
    held += std::abs(wrap_angle(a.yaw_rad - kYaw_rad)) < 2.0 * a.yaw_sigma_rad;
  }
  EXPECT_GE(held, runs * 9 / 10);
}

TEST(InOurFrame, EverythingIsWhereItWouldBeIfItHadBeenToldInOurs) {
  FrameAlignment a{
      .yaw_rad = 0.5 * kPi, .shift_m = {1, 2, 0}, .yaw_sigma_rad = 0, .position_sigma_m = 0};
  FleetMember m;
  m.position_enu_m = {1, 0, 1};
  m.velocity_enu_m_s = {1, 0, 0};
  m.yaw_rad = 0.1;
  m.plan.count = 1;
  m.plan.pieces[0].duration_s = 1.0;
  m.plan.pieces[0].coefficients.row(0) = Vec3(1, 0, 1).transpose();
  m.plan.pieces[0].coefficients.row(1) = Vec3(1, 0, 0).transpose();
  m.person_count = 1;
  m.persons[0].position_enu_m = {0, 1, 1};
  m.persons[0].covariance(0, 0) = 4.0;
  m.seat = Seat::of(0, SeatRing::kFar);
  m.bids[m.seat.number].way_s = 1.5F;
  const FleetMember ours = in_our_frame(m, a);
  EXPECT_TRUE(ours.position_enu_m.isApprox(Vec3(1, 3, 1)));
  EXPECT_TRUE(ours.velocity_enu_m_s.isApprox(Vec3(0, 1, 0)));
  EXPECT_NEAR(ours.yaw_rad, 0.1 + 0.5 * kPi, 1e-12);
  EXPECT_TRUE(ours.plan.position(1.0).isApprox(Vec3(1, 4, 1)));
  EXPECT_TRUE(ours.persons[0].position_enu_m.isApprox(Vec3(0, 2, 1)));
  EXPECT_NEAR(ours.persons[0].covariance(1, 1), 4.0, 1e-9) << "turned with the frame";
  EXPECT_EQ(ours.seat, Seat::of(kSeatSectors / 4, SeatRing::kFar));
  EXPECT_EQ(ours.bids[ours.seat.number].way_s, 1.5F);
}

}  // namespace
}  // namespace foretrack
