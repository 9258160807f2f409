// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/expect_bodies.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

class ExpectBodies : public ::testing::Test {
 protected:
  ExpectBodies() {
    input_.now_s = 1.0;
    input_.vehicle = testing::hovering({0, 0, 1.5}, 0.0, 1.0);
    input_.map = &map_;
    TargetState target;
    target.stamp_s = 1.0;
    target.position_enu_m = {2.0, 0.0, 1.2};
    target.velocity_enu_m_s = {1.0, 0.0, 0.0};
    update_belief(belief_, target, nullptr, HorizonParams{});
  }
  void add_path(double probability) {
    belief_.paths[belief_.count] = belief_.paths[0];
    belief_.paths[belief_.count++].probability = probability;
  }
  void expect(const TargetBelief* belief) { expect_bodies(input_, belief, params_, courses_); }

  const GridMap map_ = known_map(testing::empty_world(), 0.15);
  PlanInput input_;
  MovingBodies bodies_;
  TargetBelief belief_;
  GapParams params_;
  BodyCourses courses_;
};

TEST_F(ExpectBodies, TheFollowedPersonStandsOnTheGroundBelowTheTorso) {
  expect(&belief_);
  ASSERT_EQ(courses_.count, 1);
  const MovingBody& body = courses_.courses[0].body;
  EXPECT_TRUE(body.followed);
  EXPECT_EQ(body.height_m, params_.person_height_m);
  EXPECT_NEAR((body.position_enu_m - Vec3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((body.expected_at(2.5) - Vec3(3.5, 0.0, 0.0)).norm(), 0.0, 1e-9);
}

TEST_F(ExpectBodies, WhoIsNotSeenAnyMoreMayBeFartherFromWhereTheyWereExpected) {
  expect(&belief_);
  const double seen_m = courses_.courses[0].body.radius_m;
  EXPECT_EQ(seen_m, params_.person_radius_m);
  input_.now_s = 1.6;
  expect(&belief_);
  EXPECT_NEAR(courses_.courses[0].body.radius_m, seen_m + 0.25, 1e-9);
  EXPECT_NEAR(courses_.courses[0].body.position_enu_m.x(), 2.6, 1e-9);
  input_.now_s = 9.0;
  expect(&belief_);
  EXPECT_NEAR(courses_.courses[0].body.radius_m, seen_m + 0.5, 1e-9);
}

TEST_F(ExpectBodies, WhoIsUnseenBelowTheVehicleMayHaveTurnedRound) {
  input_.vehicle = testing::hovering({2.5, 0, 2.6}, 0.0, 1.0);
  expect(&belief_);
  EXPECT_EQ(courses_.count, 1) << "they are seen";
  input_.now_s = 1.8;  // they are expected at 2.8, and may be at 1.2
  expect(&belief_);
  const auto gap_at = [&](const Vec3& place) {
    double least_m = 1e9;
    for (const BodyCourse& course : courses_.all())
      least_m = std::min(least_m, expected_gap_m(place, params_.hull_radius_m, course.body, 2.5));
    return least_m;
  };
  EXPECT_LT(gap_at({1.2, 0.0, 1.6}), 0.0) << "nothing sinks there";
  EXPECT_NEAR(gap_at({1.2, 0.0, 2.6}), 0.6, 1e-6) << "it stays above";
  input_.vehicle = testing::hovering({0.0, 0, 1.5}, 0.0, 1.0);
  expect(&belief_);
  EXPECT_EQ(courses_.count, 1) << "beside them the way on is not closed";
}

TEST_F(ExpectBodies, WithoutKnownGroundTheFootIsBelowTheTorsoAsThePersonIsTall) {
  const GridMap unknown =
      testing::partly_known_map(testing::empty_world(), 0.15, [](const Vec3&) { return false; });
  input_.map = &unknown;
  expect(&belief_);
  EXPECT_NEAR(courses_.courses[0].body.position_enu_m.z(), 1.2 - 0.674 * 1.75, 1e-9);
}

TEST_F(ExpectBodies, APersonOnAStepStandsOnIt) {
  World world = testing::empty_world();
  world.boxes.push_back({{2.5, -4.0, 0.0}, {6.0, 4.0, 0.3}});
  const GridMap step = known_map(world, 0.15);
  input_.map = &step;
  expect(&belief_);
  EXPECT_NEAR(courses_.courses[0].body.position_enu_m.z(), 0.0, 0.01);
  EXPECT_NEAR(courses_.courses[0].body.expected_at(3.0).z(), 0.3, 0.01);
}

TEST_F(ExpectBodies, UnlikelyCoursesCountOverAShortTimeAndVeryUnlikelyOnesNotAtAll) {
  add_path(0.3);
  add_path(0.02);
  expect(&belief_);
  ASSERT_EQ(courses_.count, 2);
  EXPECT_EQ(courses_.courses[0].horizon_s, params_.body_horizon_s);
  EXPECT_EQ(courses_.courses[1].horizon_s, params_.unlikely_horizon_s);
}

TEST_F(ExpectBodies, TheFollowedPersonAmongTheBodiesIsTakenOnceWithTheirSize) {
  MovingBody child;
  child.followed = true;
  child.id = 7;
  child.position_enu_m = {2.1, 0.0, 0.0};
  child.height_m = 1.1;
  bodies_.add(child);
  input_.bodies = &bodies_;
  expect(&belief_);
  ASSERT_EQ(courses_.count, 1);
  EXPECT_EQ(courses_.courses[0].body.id, 7U);
  EXPECT_EQ(courses_.courses[0].body.height_m, 1.1);
  // Without a belief, they are where the bodies have them.
  expect(nullptr);
  ASSERT_EQ(courses_.count, 1);
  EXPECT_EQ(courses_.courses[0].body.position_enu_m.x(), 2.1);
}

TEST_F(ExpectBodies, BystandersCountIfTheyCanComeNearAndAreWiderByTheirDoubt) {
  MovingBody near, far;
  near.position_enu_m = {0.0, 3.0, 0.0};
  near.position_covariance_m2 = 0.04 * Mat2::Identity();
  far.position_enu_m = {0.0, 40.0, 0.0};
  bodies_.add(near);
  bodies_.add(far);
  input_.bodies = &bodies_;
  expect(nullptr);
  ASSERT_EQ(courses_.count, 1);
  EXPECT_NEAR(courses_.courses[0].body.radius_m, 0.25 + 0.2, 1e-9);
}

}  // namespace
}  // namespace foretrack
