// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/body_track.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace foretrack {
namespace {

const BodyParams kParams;

BodySighting person_at(double x_m, double y_m) {
  return {.kind = BodyKind::kPerson,
          .position_enu_m = {x_m, y_m, 0.0},
          .covariance_m2 = 0.01 * Mat2::Identity(),
          .radius_m = 0.3,
          .height_m = 1.8};
}

// Walks along x at 1.5 m/s, seen exactly, from second 1 on.
BodyTrack walker(int sightings) {
  BodyTrack track = begin_track(person_at(0.0, 2.0), 1.0, kParams);
  for (int k = 1; k < sightings; ++k) {
    const double now_s = 1.0 + 0.1 * k;
    predict_track(track, now_s, kParams);
    correct_track(track, person_at(0.15 * k, 2.0), now_s);
  }
  return track;
}

TEST(BodyTrack, LearnsTheVelocityOfWhoWalks) {
  const BodyTrack track = walker(12);
  EXPECT_NEAR(track.velocity_m_s().x(), 1.5, 0.05);
  EXPECT_NEAR(track.velocity_m_s().y(), 0.0, 1e-6);
  EXPECT_NEAR(track.position_m().x(), 1.65, 0.03);
  EXPECT_EQ(track.hits, 12);
  EXPECT_EQ(track.born_m, Vec2(0.0, 2.0));
}

TEST(BodyTrack, IsLessCertainTheLongerItIsNotSeenAndNeverGoesBackInTime) {
  BodyTrack track = walker(12);
  const BodyTrack before = track;
  predict_track(track, before.stamp_s - 0.5, kParams);
  EXPECT_EQ(track.mean, before.mean);
  EXPECT_EQ(track.stamp_s, before.stamp_s);
  predict_track(track, before.stamp_s + 1.0, kParams);
  EXPECT_NEAR(track.position_m().x(), before.position_m().x() + before.velocity_m_s().x(), 1e-9);
  EXPECT_GT(track.covariance(0, 0),
            before.covariance(0, 0) + kParams.acceleration_density_m2_s3 / 3.0);
}

TEST(BodyTrack, ALateSightingIsComparedWithWhereTheBodyWasThen) {
  const BodyTrack track = walker(12);  // at 2.1 s
  const double late_s = track.stamp_s - 0.4;
  const Vec2 then_m = track.position_m() - 0.4 * track.velocity_m_s();
  EXPECT_LT(match(track, person_at(then_m.x(), then_m.y()), late_s).mahalanobis2, 1e-9);
  EXPECT_GT(match(track, person_at(then_m.x(), then_m.y()), track.stamp_s).mahalanobis2, 4.0);
}

TEST(BodyTrack, OfTwoSightingsAsFarAwayTheSurerOneFitsBetterOnlyIfItIsNear) {
  const BodyTrack track = walker(12);
  BodySighting sure = person_at(track.position_m().x(), track.position_m().y());
  BodySighting vague = sure;
  vague.covariance_m2 *= 100.0;
  EXPECT_LT(match(track, sure, track.stamp_s).cost(), match(track, vague, track.stamp_s).cost());
  sure.position_enu_m.y() += 1.0;
  vague.position_enu_m.y() += 1.0;
  EXPECT_GT(match(track, sure, track.stamp_s).cost(), match(track, vague, track.stamp_s).cost());
}

TEST(BodyTrack, WhoWasSeenButAFewTimesIsNotBelievedForLong) {
  BodyTrack seldom = walker(2), often = walker(12);
  seldom.id = often.id = 1;
  EXPECT_FALSE(is_over(seldom, seldom.seen_s + 0.39, kParams));
  EXPECT_TRUE(is_over(seldom, seldom.seen_s + 0.41, kParams));
  EXPECT_FALSE(is_over(often, often.seen_s + kParams.coast_s - 0.01, kParams));
  EXPECT_TRUE(is_over(often, often.seen_s + kParams.coast_s + 0.01, kParams));
}

TEST(BodyTrack, APersonSeenWholeReplacesWhatDepthPutTogether) {
  BodySighting part = person_at(0.0, 0.0);
  part.kind = BodyKind::kUnknown;
  part.position_enu_m.z() = 0.5;
  part.height_m = 0.4;
  BodyTrack track = begin_track(part, 1.0, kParams);
  part.position_enu_m.z() = 0.8;
  part.height_m = 0.6;
  correct_track(track, part, 1.1);
  EXPECT_NEAR(track.foot_m, 0.5, 1e-12);
  EXPECT_NEAR(track.top_m, 1.4, 1e-12);
  correct_track(track, person_at(0.0, 0.0), 1.2);
  EXPECT_EQ(track.kind, BodyKind::kPerson);
  EXPECT_NEAR(track.foot_m, 0.0, 1e-12);
  EXPECT_NEAR(track.top_m, 1.8, 1e-12);
  correct_track(track, part, 1.3);
  EXPECT_EQ(track.kind, BodyKind::kPerson) << "a part of them is still them";
  EXPECT_NEAR(track.top_m, 1.8, 1e-12);
}

TEST(BodyTrack, CovarianceStaysSymmetricAndPositive) {
  BodyTrack track = walker(200);
  EXPECT_LT((track.covariance - track.covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(track.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace foretrack
