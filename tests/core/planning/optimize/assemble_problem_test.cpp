// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/assemble_problem.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/core/planning/see/expected_walks.hpp"

namespace foretrack {
namespace {

using testing::add_walk;
using testing::empty_world;
using testing::FlatContext;

constexpr double kHeight_m = 1.5;

class AssembleProblem : public ::testing::Test {
 protected:
  AssembleProblem() {
    path_.vertices = {{-2.0, 0.0, kHeight_m}, {0.0, 0.0, kHeight_m}, {1.5, 1.0, kHeight_m}};
    path_.times_s = {0.0, 1.5, 3.2};
    problem_.bodies.reserve(256);
  }
  bool corridor(const FlatContext& c) {
    return build_corridor(c.context(), path_, deviation_, workspace_, problem_.corridor);
  }
  void guess(const FlatContext& c) {
    PlanStart start;
    start.state.position = path_.vertices.front();
    guess_trajectory(c.context(), path_, start, expected_, problem_);
  }
  FlightPath path_;
  ExpectedTarget expected_;
  DeviationBound deviation_;
  CorridorWorkspace workspace_;
  OptimizationProblem problem_;
};

TEST_F(AssembleProblem, EachSegmentHasItsPolytopeAndABlockedOneIsTold) {
  const FlatContext open(known_map(empty_world(), 0.15), kHeight_m);
  EXPECT_TRUE(corridor(open));
  ASSERT_EQ(problem_.corridor.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(problem_.corridor[i].contains(path_.vertices[i], 0.0));
    EXPECT_TRUE(problem_.corridor[i].contains(path_.vertices[i + 1], 0.0));
  }
  World world = empty_world();
  world.boxes.push_back({{-1.2, -1.0, 0.0}, {-0.9, 1.0, 4.0}});
  EXPECT_FALSE(corridor(FlatContext(known_map(world, 0.15), kHeight_m)));
}

TEST_F(AssembleProblem, KeepsRoomForWhatTheVehicleLeavesItsPlansByWhereThereIsRoom) {
  World world = empty_world();
  world.boxes.push_back({{-4.0, 0.9, 0.0}, {0.0, 1.2, 4.0}});
  const FlatContext wide(known_map(world, 0.15), kHeight_m);
  const auto room_m = [&] {  // from the wall
    EXPECT_TRUE(corridor(wide));
    double y_m = 0.0;
    while (problem_.corridor[0].contains({-1.5, y_m, kHeight_m}, 0.0)) y_m += 0.01;
    return 0.9 - y_m;
  };
  const double before_m = room_m();
  for (int i = 0; i < 100; ++i) deviation_.add(1.3, 1.0, 0.29);
  EXPECT_GT(room_m(), before_m + 0.1);
  // A way that is narrower stays passable.
  world = empty_world();
  world.boxes.push_back({{-4.0, -1.2, 0.0}, {0.0, -0.45, 4.0}});
  EXPECT_TRUE(corridor(FlatContext(known_map(world, 0.15), kHeight_m)));
}

TEST_F(AssembleProblem, TheGuessGoesAlongThePathInItsTimes) {
  const FlatContext c(known_map(empty_world(), 0.15), kHeight_m);
  add_walk(expected_, 1.0, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(corridor(c));
  guess(c);
  ASSERT_EQ(problem_.durations_s.size(), 4u);
  ASSERT_EQ(problem_.inner_waypoints.size(), 3u);
  EXPECT_NEAR(std::accumulate(problem_.durations_s.begin(), problem_.durations_s.end(), 0.0), 3.2,
              1e-9);
  EXPECT_LT((problem_.inner_waypoints[0] - Vec3(-1.0, 0.0, kHeight_m)).norm(), 1e-9);
  EXPECT_LT((problem_.inner_waypoints[1] - path_.vertices[1]).norm(), 1e-9);
  EXPECT_EQ(problem_.goal.position, path_.vertices.back()) << "one path: where it ends";
  EXPECT_NEAR(problem_.height_above_target_m, 0.5, 1e-9);
  EXPECT_NEAR(problem_.min_total_duration_s, 3.0, 1e-9);
}

TEST_F(AssembleProblem, ThePlanEndsAsFastAsTheTargetWalksIfThereIsRoomToStop) {
  const FlatContext open(known_map(empty_world(), 0.15), kHeight_m);
  add_walk(expected_, 1.0, {0.0, 0.0, 1.0}, {1.5, 0.0, 0.0});
  ASSERT_TRUE(corridor(open));
  guess(open);
  EXPECT_LT((problem_.goal.velocity - Vec3(1.5, 0.0, 0.0)).norm(), 1e-9);
  World world = empty_world();
  world.boxes.push_back({{2.0, -1.0, 0.0}, {2.3, 3.0, 4.0}});
  const FlatContext walled(known_map(world, 0.15), kHeight_m);
  ASSERT_TRUE(corridor(walled));
  guess(walled);
  EXPECT_LT(problem_.goal.velocity.norm(), 0.9);
}

TEST_F(AssembleProblem, TheEndOfThePlanIsChosenForAllPathsOfTheTarget) {
  const FlatContext c(known_map(empty_world(), 0.15), kHeight_m);
  add_walk(expected_, 0.5, {0.5, 1.0, 1.0}, {1.0, 0.0, 0.0});
  add_walk(expected_, 0.5, {3.5, 1.0, 1.0}, {-1.0, 0.0, 0.0});  // comes to 0.5 m: too near
  ASSERT_TRUE(corridor(c));
  guess(c);
  const auto off_ring_m = [&](const Vec3& goal) {
    double sum = 0.0;
    for (int i = 0; i < expected_.count; ++i)
      sum += std::abs(distance_xy(goal, expected_.paths[i].positions_enu_m.back()) - 2.0);
    return sum;
  };
  EXPECT_LT(off_ring_m(problem_.goal.position), off_ring_m(path_.vertices.back()));
  EXPECT_TRUE(problem_.corridor.back().contains(problem_.goal.position, 0.0));
}

TEST_F(AssembleProblem, OnlyWhoComesNearTheWayIsKeptClearOf) {
  const FlatContext c(known_map(empty_world(), 0.15), kHeight_m);
  add_walk(expected_, 1.0, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(corridor(c));
  guess(c);
  BodyCourses courses;
  BodyCourse near;
  near.probability = 0.5;
  near.horizon_s = 1.0;
  near.body.position_enu_m << (path_.vertices[0] + Vec3(0.0, 1.0, 0.0)).head<2>(), 0.0;
  BodyCourse far = near;
  far.body.position_enu_m = {0.0, -6.0, 0.0};
  courses.add(near);
  courses.add(far);
  SearchContext context = c.context();
  add_bodies(context, path_, problem_);
  EXPECT_TRUE(problem_.bodies.empty()) << "nobody is known";
  SearchContext with_bodies{context.map,
                            context.surface,
                            context.params,
                            context.limits,
                            context.wanted_distance_m,
                            context.ring_tolerance_m,
                            &courses,
                            0.0};
  add_bodies(with_bodies, path_, problem_);
  ASSERT_EQ(problem_.bodies.size(), 10u) << "0.1 s apart, over its horizon";
  for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
    const BodySample& sample = problem_.bodies[i];
    EXPECT_NEAR(sample.time_s, 0.1 * static_cast<double>(i + 1), 1e-9);
    EXPECT_LE(sample.weight, 0.5);
    EXPECT_NEAR((sample.pillar.foot - near.body.position_enu_m).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace foretrack
