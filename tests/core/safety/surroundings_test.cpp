// SPDX-License-Identifier: Apache-2.0
#include "core/safety/surroundings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

/// The open map with a wall of occupied cells at x from wall_x_m on.
GridMap map_with_wall(double wall_x_m) {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x)
        if (map.center_of({x, y, z}).x() > wall_x_m)
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

constexpr ObstacleRoom kRoom{0.25, 0.3, 0.3};

GateSurroundings around(const FlightBounds& bounds) {
  return {.bounds = bounds};
}

Course course_of(const PlannedTrajectory& plan) {
  return Course(plan, 0.0);
}

TEST(Surroundings, FindsTheWallThatAPlanLeadsTooNear) {
  const PlannedTrajectory plan = straight_plan(1, 0.0);  // to x = 1.25
  const double end_s = plan.duration_s();
  EXPECT_LT(time_at_obstacle(course_of(plan), map_with_wall(2.0), kRoom, 5.0, end_s), 0.0);
  const double at_s = time_at_obstacle(course_of(plan), map_with_wall(1.0), kRoom, 5.0, end_s);
  ASSERT_GT(at_s, 0.0);
  EXPECT_NEAR(plan.position(at_s).x(), 0.7, 0.2);
  EXPECT_LT(time_at_obstacle(course_of(plan), map_with_wall(1.0), kRoom, 5.0, 0.5), 0.0)
      << "not so soon";
}

TEST(Surroundings, RefusesTheUnknownAndWhatIsOutsideOfTheMap) {
  const PlannedTrajectory inside = straight_plan(1, 0.0);
  EXPECT_LT(time_at_obstacle(course_of(inside), open_map(), kRoom, 5.0, 9.0), 0.0);
  const PlannedTrajectory leaves = straight_plan(1, 0.0, 19.0);
  EXPECT_GT(time_at_obstacle(course_of(leaves), open_map(), kRoom, 5.0, 9.0), 0.0);
  GridMap unknown = open_map();
  for (auto& cell : unknown.cells) cell = static_cast<std::uint8_t>(Cell::kUnknown);
  DistanceWorkspace workspace;
  update_distances(unknown, workspace);
  EXPECT_GT(time_at_obstacle(course_of(inside), unknown, kRoom, 5.0, 9.0), 1.5)
      << "what begins in the unknown leaves it within a metre";
}

TEST(Surroundings, ABeginTooNearIsLeftAndNotMadeWorse) {
  const GridMap map = map_with_wall(1.0);
  PlannedTrajectory away = straight_plan(1, 0.0);
  for (auto& piece : away.pieces) {
    piece.coefficients.col(0) *= -1.0;
    piece.coefficients(0, 0) += 0.85;
  }
  EXPECT_LT(time_at_obstacle(course_of(away), map, kRoom, 5.0, 9.0), 0.0);
  const PlannedTrajectory nearer = straight_plan(1, 0.0, 0.85);
  EXPECT_GT(time_at_obstacle(course_of(nearer), map, kRoom, 5.0, 9.0), 0.0);
  // Away, and back again.
  PlannedTrajectory back = away;
  const QuinticPiece away_piece = away.pieces[0];
  QuinticPiece returns{.duration_s = 2.0};
  returns.coefficients.row(0) = away_piece.position(2.0);
  returns.coefficients.row(1) = Vec3(0.5, 0, 0);
  back.pieces = {away_piece, returns};
  EXPECT_GT(time_at_obstacle(course_of(back), map, kRoom, 5.0, 9.0), 2.0);
}

// The same way, slowly, passes.
TEST(Surroundings, WhatTheVehicleLeavesFastPlansByNeedsRoom) {
  const GridMap map = map_with_wall(1.0);
  PlannedTrajectory plan = straight_plan(1, 0.0, 0.0);  // along y, 0.35 m from the wall
  for (auto& piece : plan.pieces) {
    piece.coefficients.col(1) = piece.coefficients.col(0);
    piece.coefficients.col(0).setZero();
    piece.coefficients(0, 0) = 0.64;
  }
  const double clear_m = map.unfree_distance_m(plan.position(0.5));
  ASSERT_GT(clear_m, 0.3);
  DeviationBound deviation;
  const ObstacleRoom room{0.25, 0.3, 0.6, &deviation};
  EXPECT_LT(time_at_obstacle(course_of(plan), map, room, 5.0, 9.0), 0.0);
  for (int i = 0; i < 200; ++i) deviation.add(1.0, 0.0, 0.29);
  PlannedTrajectory comes = plan;  // from where there is room
  for (auto& piece : comes.pieces) piece.coefficients(1, 0) = 0.3, piece.coefficients(0, 0) -= 0.6;
  comes.pieces[1].coefficients(0, 0) += 0.6;
  comes.pieces.pop_back();
  EXPECT_LT(time_at_obstacle(course_of(comes), map, kRoom, 5.0, 2.0), 0.0);
  EXPECT_GT(time_at_obstacle(course_of(comes), map, room, 5.0, 2.0), 0.5);
  EXPECT_LT(time_at_obstacle(course_of(comes), map, {0.25, 0.3, 0.31, &deviation}, 5.0, 2.0), 0.0)
      << "it asks for no more than it is told to";
  const Course stop(Vec3(0.64, 0, 1.5), Vec3(0, 3, 0), 3.0);
  EXPECT_DOUBLE_EQ(stop.acceleration(0.1), 3.0);
}

// A step 0.75 m up at x > 0.5, and nothing seen beyond x = 3.
GridMap map_with_step() {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const Vec3 center = map.center_of({x, y, z});
        Cell is = Cell::kFree;
        if (center.x() > 0.5 && center.z() < 0.75) is = Cell::kOccupied;
        if (center.x() > 3.0 && center.z() < 1.0) is = Cell::kUnknown;
        map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(is);
      }
  return map;
}

TEST(Surroundings, HeightsCountFromTheGroundBelow) {
  const GridMap map = map_with_step();
  const GateSurroundings around{.map = &map, .ground_m = 0.2};
  EXPECT_DOUBLE_EQ(over_ground(around, Vec3(-2, 0, 1.5)).z(), 1.5);
  EXPECT_DOUBLE_EQ(over_ground(around, Vec3(2, 1, 1.5)).z(), 0.75);
  EXPECT_DOUBLE_EQ(over_ground(around, Vec3(5, 0, 1.5)).z(), 1.3) << "not seen: as known last";
  EXPECT_DOUBLE_EQ(over_ground({.ground_m = 0.2}, Vec3(2, 0, 1.5)).z(), 1.3);
}

TEST(Surroundings, FindsWhereAPlanFliesTooLowOverAStep) {
  const GridMap map = map_with_step();
  const GateSurroundings around{.map = &map};
  const PlannedTrajectory plan = straight_plan(1, 0.0);  // at 1.5 m, to x = 1.25
  EXPECT_NEAR(time_too_low(course_of(plan), around, 1.0, 9.0), 1.0, 0.05);
  EXPECT_LT(time_too_low(course_of(plan), around, 0.7, 9.0), 0.0);
  EXPECT_LT(time_too_low(course_of(plan), around, 1.0, 0.5), 0.0);
  const PlannedTrajectory there = straight_plan(1, 0.0, 1.0);
  EXPECT_LT(time_too_low(course_of(there), around, 1.0, 9.0), 0.0) << "it begins there";
  PlannedTrajectory down = there;  // over the edge
  for (auto& piece : down.pieces) piece.coefficients.col(0).tail(5) *= -1.0;
  down.pieces[1].coefficients(0, 0) -= 2.0;
  FlightBounds low;
  low.altitude_max_m = 1.4;
  EXPECT_NEAR(time_out_of_bounds(course_of(down), {.map = &map, .bounds = low}, 0.5, 9.0), 1.0,
              0.05);
}

TEST(Surroundings, RoomIsTheDistanceToFenceAndAltitudes) {
  FlightBounds bounds;
  EXPECT_TRUE(std::isinf(room_m(bounds, Vec3::Zero())));
  bounds.altitude_min_m = 1.0;
  bounds.altitude_max_m = 5.0;
  EXPECT_DOUBLE_EQ(room_m(bounds, Vec3(0, 0, 1.5)), 0.5);
  EXPECT_DOUBLE_EQ(room_m(bounds, Vec3(0, 0, 7.0)), -2.0);
  bounds.corner_count = 5;  // not convex: a notch from above
  bounds.corners_enu_m = {{{0, 0}, {10, 0}, {10, 10}, {5, 4}, {0, 10}}};
  EXPECT_DOUBLE_EQ(room_m(bounds, Vec3(5, 1, 3)), 1.0);
  EXPECT_DOUBLE_EQ(room_m(bounds, Vec3(-2, 1, 3)), -2.0);
  EXPECT_LT(room_m(bounds, Vec3(5, 6, 3)), 0.0) << "in the notch";
  EXPECT_GT(room_m(bounds, Vec3(1, 5, 3)), 0.0);
  bounds.corners_enu_m[0] = bounds.corners_enu_m[4] = {0, 10};  // an edge of no length
  EXPECT_TRUE(std::isfinite(room_m(bounds, Vec3(5, 1, 3))));
}

TEST(Surroundings, FindsWhereAPlanLeavesItsBounds) {
  FlightBounds bounds;
  bounds.corner_count = 4;
  bounds.corners_enu_m = {{{-2, -2}, {1, -2}, {1, 2}, {-2, 2}}};
  const PlannedTrajectory plan = straight_plan(1, 0.0);
  const double at_s = time_out_of_bounds(course_of(plan), around(bounds), 0.5, 9.0);
  EXPECT_NEAR(at_s, 1.0, 0.03);  // at x = 0.5
  EXPECT_LT(time_out_of_bounds(course_of(plan), around(bounds), 0.5, 0.5), 0.0);
  EXPECT_LT(time_out_of_bounds(course_of(plan), around({}), 0.5, 9.0), 0.0);
  // From outside it may come in, and not go farther out.
  const PlannedTrajectory out = straight_plan(1, 0.0, 2.0);
  EXPECT_GT(time_out_of_bounds(course_of(out), around(bounds), 0.5, 9.0), 0.0);
  const PlannedTrajectory in = straight_plan(1, 0.0, -3.0);
  EXPECT_LT(time_out_of_bounds(course_of(in), around(bounds), 0.5, 9.0), 0.0);
}

TEST(Surroundings, AStopComesToRestWhereItsBrakingEnds) {
  const Course stop(Vec3(1, 0, 2), Vec3(3, 0, 0), 3.0);
  EXPECT_DOUBLE_EQ(stop.duration_s(), 1.0);
  EXPECT_NEAR(stop.position(1.0).x(), 2.5, 1e-9);
  EXPECT_NEAR(stop.position(5.0).x(), 2.5, 1e-9);
  EXPECT_DOUBLE_EQ(stop.speed(0.5), 1.5);
  EXPECT_DOUBLE_EQ(stop.speed(2.0), 0.0);
  const Course still(Vec3(1, 0, 2), Vec3::Zero(), 3.0);
  EXPECT_EQ(still.position(1.0), Vec3(1, 0, 2));
}

TEST(Surroundings, TheLeastGapIsThatOfThePassage) {
  MovingBody walker;
  walker.position_enu_m = Vec3(4, 1, 0);
  walker.velocity_enu_m_s = Vec3(-1, 0, 0);
  const Course still(Vec3(2, 0, 1.2), Vec3::Zero(), 3.0);
  EXPECT_NEAR(least_expected_gap_m(still, walker, 0.25, 0.0, 4.0), 1.0 - 0.5, 1e-3);
  EXPECT_GT(least_expected_gap_m(still, walker, 0.25, 0.0, 1.0), 0.8);
}

}  // namespace
}  // namespace foretrack::testing
