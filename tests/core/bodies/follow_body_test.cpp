// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/follow_body.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr double kHeight_m = 1.75;
const BodyParams kBodyParams;

TargetState ada() {
  TargetState target;
  target.stamp_s = target.last_measurement_s = 10.0;
  target.status = TrackStatus::kTracking;
  target.position_enu_m = {2.0, 0.0, kTorsoShare * kHeight_m};
  target.velocity_enu_m_s = {1.0, 0.0, 0.0};
  target.covariance = 0.01 * Mat6::Identity();
  return target;
}

/// Ada is followed under number 1; Bob is tracked under number 2.
BodiesState street() {
  BodiesState state;
  state.newest_s = 10.0;
  state.last_id = 2;
  state.followed_id = 1;
  state.followed_look.stamp_s = 9.0;
  state.count = 2;
  BodyTrack& bob = state.tracks[0];
  bob.id = 2;
  bob.kind = BodyKind::kPerson;
  bob.stamp_s = bob.seen_s = 10.0;
  bob.hits = 9;
  bob.mean << 5.0, 1.0, 0.0, -1.2;
  bob.covariance = 0.04 * Mat4::Identity();
  bob.foot_m = 0.3;
  bob.top_m = 2.0;
  bob.look.stamp_s = 9.9;
  state.tracks[1] = bob;
  state.tracks[1].id = 0;  // somebody who is not believed yet
  return state;
}

const BodyTrack* track(const BodiesState& state, std::uint32_t id) {
  for (const BodyTrack& t : state.all())
    if (t.id == id) return &t;
  return nullptr;
}

TEST(FollowBody, GoesOnFromTheTracksMotion) {
  BodiesState state = street();
  const auto bob = follow_body(state, 2, ada(), Numbers::kStay, kHeight_m, kBodyParams);
  ASSERT_TRUE(bob);
  EXPECT_EQ(bob->status, TrackStatus::kTracking);
  EXPECT_LT((bob->position_enu_m - Vec3(5.0, 1.0, 0.3 + kTorsoShare * kHeight_m)).norm(), 1e-9);
  EXPECT_EQ(bob->velocity_enu_m_s, Vec3(0.0, -1.2, 0.0));
  EXPECT_NEAR(bob->covariance(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(bob->covariance(4, 4), 0.04, 1e-12);
  EXPECT_GT(bob->covariance(2, 2), 0.0);
  EXPECT_EQ(state.followed_look.stamp_s, 9.9);
}

TEST(FollowBody, WhoWasFollowedIsOneOfTheOthersAndEverybodyKeepsTheirNumber) {
  BodiesState state = street();
  follow_body(state, 2, ada(), Numbers::kStay, kHeight_m, kBodyParams);
  EXPECT_EQ(state.followed_id, 2u);
  EXPECT_EQ(track(state, 2), nullptr);
  const BodyTrack* left = track(state, 1);
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(left->position_m(), Vec2(2.0, 0.0));
  EXPECT_EQ(left->velocity_m_s(), Vec2(1.0, 0.0));
  EXPECT_NEAR(left->foot_m, 0.0, 1e-9);
  EXPECT_EQ(left->kind, BodyKind::kPerson);
  EXPECT_FALSE(is_over(*left, 11.0, kBodyParams)) << "they are believed for as long as anybody";
}

TEST(FollowBody, WhoIsFoundAgainHasTheirNumberBack) {
  BodiesState state = street();
  follow_body(state, 2, ada(), Numbers::kSwap, kHeight_m, kBodyParams);
  EXPECT_EQ(state.followed_id, 1u);
  ASSERT_NE(track(state, 2), nullptr);
  EXPECT_EQ(track(state, 2)->position_m(), Vec2(2.0, 0.0));
}

TEST(FollowBody, WhoIsLostLeavesNoTrack) {
  BodiesState state = street();
  TargetState lost = ada();
  lost.status = TrackStatus::kLost;
  ASSERT_TRUE(follow_body(state, 2, lost, Numbers::kSwap, kHeight_m, kBodyParams));
  EXPECT_EQ(state.count, 1);
  EXPECT_EQ(state.followed_id, 1u);
}

TEST(FollowBody, NobodyOfThatNumberChangesNothing) {
  BodiesState state = street();
  for (const std::uint32_t id : {0u, 9u})
    EXPECT_FALSE(follow_body(state, id, ada(), Numbers::kStay, kHeight_m, kBodyParams));
  EXPECT_EQ(state.followed_id, 1u);
  EXPECT_EQ(state.count, 2);
}

TEST(FollowBody, NobodyIsFollowedAndTheyAreStillThere) {
  BodiesState state = street();
  follow_no_body(state, ada(), kHeight_m, kBodyParams);
  EXPECT_EQ(state.followed_id, 0u);
  EXPECT_FALSE(state.followed_look.known());
  ASSERT_NE(track(state, 1), nullptr);
  EXPECT_EQ(track(state, 1)->position_m(), Vec2(2.0, 0.0));
}

}  // namespace
}  // namespace foretrack
