// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/cut_bodies.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

const Vec3 kFrom(-1.0, 0.0, 1.5), kTo(1.0, 0.0, 1.5);
constexpr double kHull_m = 0.25;

class CutBodies : public ::testing::Test {
 protected:
  // The room beside the segment, which is flown in the second second.
  Polytope room(const Vec3& foot, const Vec3& velocity, double height_m = 1.75) {
    courses_.count = 0;
    BodyCourse course;
    course.body.position_enu_m = foot;
    course.body.velocity_enu_m_s = velocity;
    course.body.height_m = height_m;
    course.horizon_s = 3.0;
    courses_.add(course);
    SearchContext context = open_.context();
    context.courses = &courses_;
    Polytope polytope;
    cut_bodies(context, kFrom, kTo, 1.0, 2.0, polytope);
    EXPECT_TRUE(polytope.contains(kFrom, -0.05) && polytope.contains(kTo, -0.05));
    return polytope;
  }
  testing::FlatContext open_{known_map(testing::empty_world(), 0.15), 1.5};
  BodyCourses courses_;
};

TEST_F(CutBodies, TheCorridorEndsBeforeWhoStandsBesideIt) {
  const Polytope polytope = room({0.0, 2.0, 0.0}, Vec3::Zero());
  EXPECT_FALSE(polytope.contains({0.0, 2.0, 1.5}));
  const double free_m = 2.0 - 0.25 - kHull_m - open_.params.body.gap_min_m;
  EXPECT_TRUE(polytope.contains({0.0, free_m - 0.01, 1.5}));
  EXPECT_FALSE(polytope.contains({0.0, free_m + 0.01, 1.5}));
}

TEST_F(CutBodies, WhereThereIsLessRoomTheSegmentKeepsItsOwn) {
  const Polytope polytope = room({0.0, 0.75, 0.0}, Vec3::Zero());
  EXPECT_FALSE(polytope.contains({0.0, 0.75 - 0.25 - kHull_m, 1.5}));
}

TEST_F(CutBodies, WhatCountsIsWhereTheyAreMeanwhile) {
  // Walks along, and is beside the segment in the second second.
  const Polytope along = room({-1.5, 1.5, 0.0}, {1.0, 0.0, 0.0});
  EXPECT_FALSE(along.contains({-0.5, 1.5, 1.5}));
  EXPECT_FALSE(along.contains({0.5, 1.5, 1.5}));
  // Has gone away by then.
  const Polytope gone = room({0.0, 1.0, 0.0}, {0.0, 2.0, 0.0});
  EXPECT_TRUE(gone.contains({0.0, 1.0, 1.5}));
}

TEST_F(CutBodies, WhoCrossesIsPassedInTimeAndWhoIsLowIsFlownOver) {
  EXPECT_TRUE(room({0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}).planes.empty());
  EXPECT_TRUE(room({0.0, 1.2, 0.0}, Vec3::Zero(), 0.5).planes.empty());
  EXPECT_FALSE(room({0.0, 1.2, 0.0}, Vec3::Zero()).planes.empty());
}

}  // namespace
}  // namespace foretrack
