// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/bodies_around.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TargetState walking_target() {
  TargetState target;
  target.stamp_s = 10.0;
  target.status = TrackStatus::kTracking;
  target.position_enu_m = {2.0, 1.0, 1.2};
  target.velocity_enu_m_s = {1.5, 0.0, 0.1};
  target.covariance = 0.04 * Mat6::Identity();
  return target;
}

// Turns left after a second.
Prediction turning() {
  Prediction prediction;
  prediction.stamp_s = 9.9;
  prediction.status = PredictionStatus::kOk;
  PredictedPath likely{Intention{1}, 0.8, {}}, other{Intention{0}, 0.2, {}};
  for (int k = 1; k <= 15; ++k) {
    const double t = 0.2 * k;
    const Vec3 place(1.85 + 1.5 * std::min(t, 1.0), 1.0 + 1.5 * std::max(t - 1.0, 0.0), 1.2);
    likely.states.push_back({t, place, Vec3::Zero(), Mat2::Identity()});
    other.states.push_back({t, {1.85 + 1.5 * t, 1.0, 1.2}, Vec3::Zero(), Mat2::Identity()});
  }
  prediction.paths = {likely, other};
  return prediction;
}

TEST(BodiesAround, FollowedPersonStandsUnderTheTorso) {
  const TargetState target = walking_target();
  const MovingBody body = followed_body({target, nullptr, 1.8}, 10.1, {});
  EXPECT_TRUE(body.followed);
  EXPECT_EQ(body.kind, BodyKind::kPerson);
  EXPECT_NEAR(body.position_enu_m.x(), 2.15, 1e-9);
  EXPECT_NEAR(body.position_enu_m.z(), 1.2 - kTorsoShare * 1.8, 1e-9);
  EXPECT_EQ(body.height_m, 1.8);
  EXPECT_EQ(body.velocity_enu_m_s, Vec3(1.5, 0.0, 0.0));
  EXPECT_GT(body.position_covariance_m2(0, 0), 0.04);
  EXPECT_EQ(body.place_count, 0);
}

TEST(BodiesAround, FollowedPersonIsExpectedAlongTheMostProbablePath) {
  const TargetState target = walking_target();
  const Prediction prediction = turning();
  const MovingBody body = followed_body({target, &prediction, 1.75}, 10.0, {});
  ASSERT_EQ(body.place_count, 14);  // the path ends 2.9 s from now
  for (double t = 0.0; t <= 2.8; t += 0.05) {
    const double along_s = 0.1 + t;  // of the path
    const Vec2 truth(1.85 + 1.5 * std::min(along_s, 1.0), 1.0 + 1.5 * std::max(along_s - 1.0, 0.0));
    EXPECT_LT((body.expected_at(10.0 + t).head<2>() - truth).norm(), 0.11) << t;
  }
}

TEST(BodiesAround, PlacesAreThoseOfThePathAlsoBetweenItsStates) {
  TargetState target = walking_target();
  target.position_enu_m.y() += 0.2;  // beside its path, as a filter may be
  const Prediction prediction = turning();
  const MovingBody body = followed_body({target, &prediction, 1.75}, 10.03, {});
  ASSERT_EQ(body.place_count, 14);
  for (int k = 0; k < body.place_count; ++k) {
    const double on_path_s = 10.03 - 9.9 + (k + 1) * body.step_s;
    const Vec3 expected = prediction.paths[0].at(on_path_s).position_enu_m;
    EXPECT_LT((body.places_enu_m[k] - expected).head<2>().norm(), 1e-9) << k;
    EXPECT_EQ(body.places_enu_m[k].z(), body.position_enu_m.z());
  }
}

TEST(BodiesAround, APredictionThatIsOldOrEmptyIsNotUsed) {
  const TargetState target = walking_target();
  Prediction prediction = turning();
  prediction.stamp_s = 9.0;
  EXPECT_EQ(followed_body({target, &prediction}, 10.0, {}).place_count, 0);
  EXPECT_EQ(followed_body({target, nullptr}, 10.0, {}).place_count, 0);
  prediction.stamp_s = 9.9;
  prediction.paths.clear();
  EXPECT_EQ(followed_body({target, &prediction}, 10.0, {}).place_count, 0);
}

TEST(BodiesAround, FollowedPersonKeepsANumberThroughALoss) {
  BodiesState state;
  MovingBodies bodies;
  TargetState target = walking_target();
  bodies_around(state, 10.0, {target}, Vec3::Zero(), {}, bodies);
  ASSERT_EQ(bodies.count, 1);
  const std::uint32_t id = bodies.bodies[0].id;
  EXPECT_NE(id, 0u);
  target.status = TrackStatus::kLost;
  bodies_around(state, 12.0, {target}, Vec3::Zero(), {}, bodies);
  EXPECT_EQ(bodies.count, 0) << "nobody knows where they are";
  target.status = TrackStatus::kTracking;
  bodies_around(state, 13.0, {target}, Vec3::Zero(), {}, bodies);
  ASSERT_EQ(bodies.count, 1);
  EXPECT_EQ(bodies.bodies[0].id, id);
}

TEST(BodiesAround, LooksBelongToTheirBodies) {
  BodiesState state;
  BodySightings seen;
  std::array<PersonLook, 2> looks;
  for (int k = 0; k < 5; ++k) {
    seen.stamp_s = 1.0 + 0.1 * k;
    seen.count = 0;
    for (int i = 0; i < 2; ++i) {
      seen.add({.kind = BodyKind::kPerson,
                .position_enu_m = {6.0 - 3.0 * i, 0.0, 0.0},
                .covariance_m2 = 0.01 * Mat2::Identity()});
      looks[i].stamp_s = seen.stamp_s;
      looks[i].body_yaw_rad = i;
    }
    track_bodies(state, seen, {}, {}, looks);
  }
  MovingBodies bodies;
  std::array<PersonLook, MovingBodies::kCapacity> shown;
  const TargetState nobody;
  bodies_around(state, seen.stamp_s, {nobody}, Vec3::Zero(), {}, bodies, shown);
  ASSERT_EQ(bodies.count, 2);
  EXPECT_NEAR(bodies.bodies[0].position_enu_m.x(), 3.0, 0.1);
  EXPECT_EQ(shown[0].body_yaw_rad, 1.0);
  EXPECT_EQ(shown[1].body_yaw_rad, 0.0);
}

}  // namespace
}  // namespace foretrack
