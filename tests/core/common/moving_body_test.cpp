// SPDX-License-Identifier: Apache-2.0
#include "core/common/moving_body.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kHull_m = 0.25;

MovingBody walker(const Vec2& place_m, const Vec2& velocity_m_s) {
  MovingBody body;
  body.position_enu_m << place_m, 0.0;
  body.velocity_enu_m_s << velocity_m_s, 0.0;
  return body;
}

TEST(MovingBody, GapBesideIsTheHorizontalDistanceOfTheSurfaces) {
  EXPECT_NEAR(gap_m({2.0, 0.0, 1.0}, kHull_m, Vec3::Zero(), 0.25, 1.75), 1.5, 1e-12);
}

TEST(MovingBody, GapAboveIsTheVerticalDistanceOfTheSurfaces) {
  EXPECT_NEAR(gap_m({0.1, 0.0, 2.5}, kHull_m, Vec3::Zero(), 0.25, 1.75), 0.5, 1e-12);
}

TEST(MovingBody, GapOverTheEdgeIsTheDistanceToIt) {
  EXPECT_NEAR(gap_m({0.55, 0.0, 2.15}, kHull_m, Vec3::Zero(), 0.25, 1.75), 0.25, 1e-12);
}

TEST(MovingBody, GapIsNegativeWhereTheyOverlap) {
  EXPECT_LT(gap_m({0.2, 0.0, 1.0}, kHull_m, Vec3::Zero(), 0.25, 1.75), -kHull_m);
  EXPECT_LT(gap_m({0.4, 0.0, 1.0}, kHull_m, Vec3::Zero(), 0.25, 1.75), 0.0);
}

TEST(MovingBody, GoesOnWithConstantVelocityWithoutPlaces) {
  MovingBody body = walker({1.0, 2.0}, {0.5, -1.0});
  body.stamp_s = 10.0;
  EXPECT_TRUE(body.expected_at(12.0).isApprox(Vec3(2.0, 0.0, 0.0)));
  EXPECT_TRUE(body.expected_at(9.0).isApprox(body.position_enu_m));
}

TEST(MovingBody, FollowsItsPlacesAndThenTheLastStep) {
  MovingBody body = walker({0.0, 0.0}, {1.0, 0.0});
  body.step_s = 0.5;
  body.place_count = 2;
  body.places_enu_m[0] = {0.5, 0.0, 0.0};
  body.places_enu_m[1] = {0.5, 0.5, 0.0};
  EXPECT_TRUE(body.expected_at(0.25).isApprox(Vec3(0.25, 0.0, 0.0)));
  EXPECT_TRUE(body.expected_at(0.75).isApprox(Vec3(0.5, 0.25, 0.0)));
  EXPECT_TRUE(body.expected_at(1.5).isApprox(Vec3(0.5, 1.0, 0.0)));
}

TEST(MovingBody, LeastGapHoldsWhateverTheBodyDoesWithinTheBounds) {
  Random random(7);
  const BodyMotionBounds bounds;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 start_m_s = direction_of(random.uniform(-kPi, kPi)) * random.uniform(0.0, 2.0);
    const MovingBody body = walker({0.0, 0.0}, start_m_s);
    const Vec3 ball_m(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), 1.2);
    Vec2 place_m = Vec2::Zero(), velocity_m_s = start_m_s;
    constexpr double kStep_s = 0.01;
    for (int k = 1; k <= 150; ++k) {
      const Vec2 push = direction_of(random.uniform(-kPi, kPi)) * bounds.acceleration_m_s2;
      Vec2 next_m_s = velocity_m_s + kStep_s * push;
      if (next_m_s.norm() > bounds.speed_m_s) next_m_s *= bounds.speed_m_s / next_m_s.norm();
      if ((next_m_s - velocity_m_s).norm() > kStep_s * bounds.acceleration_m_s2 + 1e-12)
        next_m_s = velocity_m_s;
      place_m += 0.5 * kStep_s * (velocity_m_s + next_m_s);
      velocity_m_s = next_m_s;
    }
    const double gap =
        gap_m(ball_m, kHull_m, {place_m.x(), place_m.y(), 0.0}, body.radius_m, body.height_m);
    EXPECT_GE(gap + 1e-9, least_gap_m(ball_m, kHull_m, body, 1.5, bounds));
  }
}

TEST(MovingBodies, HoldNoMoreThanFit) {
  MovingBodies bodies;
  for (int i = 0; i < MovingBodies::kCapacity; ++i) EXPECT_TRUE(bodies.add({}));
  EXPECT_FALSE(bodies.add({}));
  EXPECT_EQ(bodies.all().size(), 16u);
}

TEST(MovingBodies, TheNearestPersonIsFoundOverTheGround) {
  MovingBodies bodies;
  EXPECT_EQ(nearest_person(bodies, Vec3::Zero()), nullptr);
  bodies.add({.id = 1, .kind = BodyKind::kVehicle});
  EXPECT_EQ(nearest_person(bodies, Vec3::Zero()), nullptr);
  bodies.add({.id = 2, .kind = BodyKind::kPerson, .position_enu_m = {5, 0, 0}});
  bodies.add({.id = 3, .kind = BodyKind::kPerson, .position_enu_m = {0, 3, 0}});
  bodies.add({.id = 4, .kind = BodyKind::kPerson, .position_enu_m = {4, 0, 0}});
  EXPECT_EQ(nearest_person(bodies, {0, 0, 9})->id, 3u);
}

}  // namespace
}  // namespace foretrack
