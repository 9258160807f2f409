// SPDX-License-Identifier: Apache-2.0
// The gate's own check, through the gate: what is refused, and that what was flown flies on.
#include "core/safety/check_plan.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"

namespace foretrack::testing {
namespace {

/// Flies along x at 0.5 m/s, and is given other plans.
struct Given : FlightLoop {
  Given() {
    take_off_and_track();
    const auto plan = straight_plan(++last_plan, stamp_now_s() + kTick_s);
    tick(&plan);
    run(0.1);
    EXPECT_EQ(result.mode, SafetyMode::kTrack);
    flown_id = result.plan_id;
  }
  /// A plan that would go on with what is flown.
  PlannedTrajectory next_plan() {
    const double start_s = stamp_now_s() + 0.02;
    const double x_m = state.flown.position(now_s + 0.02 - state.flown.start_s).x();
    return straight_plan(++last_plan, start_s, x_m);
  }
  /// What becomes of it.
  PlanFault give(const PlannedTrajectory& plan) {
    tick(&plan);
    const PlanFault fault = result.refusal;
    run(0.05);
    EXPECT_EQ(result.plan_id == plan.id, fault == PlanFault::kNone);
    if (fault != PlanFault::kNone) {
      EXPECT_EQ(result.plan_id, flown_id);
      EXPECT_EQ(state.refused[static_cast<std::size_t>(fault)], 1U);
    }
    return fault;
  }
  std::uint64_t flown_id = 0;
};

TEST(CheckPlan, TakesAPlanThatGoesOn) {
  Given loop;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone);
}

TEST(CheckPlan, ARefusedPlanLetsTheLastGoodOneAndItsStopFlyOn) {
  Given loop;
  for (int i = 0; i < 100; ++i) {
    PlannedTrajectory bad = loop.next_plan();
    bad.pieces.pop_back();  // no stop
    loop.tick(&bad);
    loop.run(0.03);
  }
  EXPECT_EQ(loop.result.mode, SafetyMode::kHover);
  EXPECT_NEAR(loop.vehicle.position_enu_m.x(), 1.25, 1e-6);
  EXPECT_TRUE(loop.result.heartbeat);
  EXPECT_EQ(loop.state.refused[static_cast<std::size_t>(PlanFault::kEndsInMotion)], 100U);
  for (int i = 0; i < 200; ++i) {
    PlannedTrajectory bad = loop.next_plan();
    bad.pieces.pop_back();
    loop.tick(&bad);
    loop.run(0.03);
  }
  EXPECT_TRUE(loop.result.heartbeat) << "the planner is alive: the place is held";
}

TEST(CheckPlan, RefusesAJumpOfPositionVelocityOrYaw) {
  for (int i = 0; i < 3; ++i) {
    Given loop;
    PlannedTrajectory plan = loop.next_plan();
    if (i == 0)
      for (auto& piece : plan.pieces) piece.coefficients(0, 1) += 0.9;
    if (i == 1)  // the other way
      for (auto& piece : plan.pieces) piece.coefficients.bottomRows(5).col(0) *= -1.0;
    if (i == 1) plan.pieces[1].coefficients(0, 0) -= 2.0;
    if (i == 2) plan.yaw.nodes = {{1.5, 0.0}};
    loop.tick(&plan);
    EXPECT_EQ(loop.result.refusal, PlanFault::kDoesNotJoin) << i;
  }
}

TEST(CheckPlan, TakesAPlanThatBeginsWhereTheVehicleIsAndNotWhereItShouldBe) {
  Given loop;
  loop.displaced = loop.vehicle.position_enu_m + Vec3(0, 0.45, 0);
  loop.run(0.05);
  PlannedTrajectory plan = still_plan(++loop.last_plan, loop.stamp_now_s() + 0.02, *loop.displaced);
  EXPECT_EQ(loop.give(plan), PlanFault::kNone);
}

TEST(CheckPlan, RefusesOldAndFutureStartsAndStampsAndWhatIsOutOfOrder) {
  const auto with = [](auto&& change) {
    Given loop;
    PlannedTrajectory plan = loop.next_plan();
    change(plan);
    return loop.give(plan);
  };
  using P = PlannedTrajectory;
  EXPECT_EQ(with([](P& p) { p.start_s -= 5.0; }), PlanFault::kOldStart);
  EXPECT_EQ(with([](P& p) { p.start_s += 5.0; }), PlanFault::kFutureStart);
  EXPECT_EQ(with([](P& p) { p.stamp_s += 5.0; }), PlanFault::kFutureStart);
  EXPECT_EQ(with([](P& p) { p.id = 1; }), PlanFault::kOutOfOrder);
  EXPECT_EQ(with([](P& p) { p.start_s -= 0.2; }), PlanFault::kOutOfOrder);
}

TEST(CheckPlan, APlannerThatWasStartedAnewMayCountAnew) {
  Given loop;
  loop.run(2.0);
  EXPECT_EQ(loop.result.mode, SafetyMode::kCoast);
  loop.last_plan = 0;
  EXPECT_EQ(loop.give(still_plan(1, loop.stamp_now_s() + 0.02, loop.vehicle.position_enu_m)),
            PlanFault::kNone);
}

TEST(CheckPlan, RefusesTooFastTooHardAndTurningTooFast) {
  Given loop;
  loop.params.speed_max_m_s = 0.4;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kTooFast);
  loop.params.speed_max_m_s = 3.0;
  loop.params.acceleration_max_m_s2 = 0.5;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kTooHard);
}

/// Occupied from x on.
GridMap wall_at(double x_m) {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x)
        if (map.center_of({x, y, z}).x() > x_m)
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

TEST(CheckPlan, RefusesAPlanTooNearAnObstacleAndBrakesWhenOneAppearsOnTheWay) {
  Given loop;
  const GridMap wall = wall_at(1.2), nearer = wall_at(0.9);
  loop.extra.map = &wall;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kObstacle);
  loop.extra.map = &nearer;
  while (loop.result.mode == SafetyMode::kTrack || loop.result.mode == SafetyMode::kCoast)
    loop.tick();
  EXPECT_EQ(loop.result.mode, SafetyMode::kBrake);
  EXPECT_EQ(loop.result.reason, SafetyReason::kPlanBlocked);
  EXPECT_LT(loop.vehicle.position_enu_m.x(), 0.6) << "the hull would touch at 0.75";
}

/// A wall along the way, whose face is at y = 0.5.
GridMap wall_beside() {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x)
        if (map.center_of({x, y, z}).y() > 0.5)
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

// The vehicle is pushed aside, so that plans of that speed need more room than they did.
TEST(CheckPlan, RefusesAPlanInsideOfWhatTheVehicleIsMeasuredToLeaveItsPlansBy) {
  const GridMap wall = wall_beside();
  for (const bool pushed : {false, true}) {
    Given loop;
    for (int i = 0; pushed && i < 40; ++i) {
      loop.vehicle.position_enu_m.y() = 0.29;
      loop.tick();
    }
    EXPECT_EQ(loop.state.deviation.bound_m(1.0, 0.0) > 0.25, pushed);
    loop.vehicle.position_enu_m.y() = 0.0;
    loop.tick();
    loop.extra.map = &wall;
    loop.params.obstacle_most_m = 0.45;
    EXPECT_EQ(loop.give(loop.next_plan()), pushed ? PlanFault::kObstacle : PlanFault::kNone);
    loop.flown_id = loop.result.plan_id;
    loop.params.obstacle_most_m = 0.3;
    loop.state.refused = {};
    EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone) << "it asks for no more than that";
  }
}

TEST(CheckPlan, AnObstacleThatANewerPlanLeadsClearOfIsNoReasonToBrake) {
  Given loop;
  const GridMap wall = wall_at(0.4);
  const GridMap& free = open_map();
  for (int i = 0; i < 100; ++i) {  // seen for half of the time that it takes to plan anew
    loop.extra.map = i % 10 < 5 ? &wall : &free;
    EXPECT_NE(loop.tick().mode, SafetyMode::kBrake) << i;
  }
}

TEST(CheckPlan, WithoutAMapOrWithAnOldOneNoPlanIsTaken) {
  Given loop;
  GridMap old = open_map();
  old.stamp_s = 1.0;
  loop.extra.map = &old;
  loop.extra.map_at_s = loop.now_s - 1.0;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone);
  loop.flown_id = loop.result.plan_id;
  loop.extra.map_at_s = loop.now_s - 3.0;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNoMap);
  const GridMap empty;
  loop.extra.map = &empty;
  loop.tick();
  PlannedTrajectory plan = loop.next_plan();
  EXPECT_EQ(loop.tick(&plan).refusal, PlanFault::kNoMap);
  loop.params.needs_map = false;
  plan = loop.next_plan();
  EXPECT_EQ(loop.tick(&plan).refusal, PlanFault::kNone);
}

MovingBodies somebody_at(const Vec3& place, const Vec3& velocity, double stamp_s) {
  MovingBodies bodies;
  MovingBody body;
  body.stamp_s = bodies.stamp_s = stamp_s;
  body.position_enu_m = place;
  body.velocity_enu_m_s = velocity;
  bodies.add(body);
  return bodies;
}

TEST(CheckPlan, RefusesAPlanThatComesTooNearSomebodyAndBrakesForWhoStepsInTheWay) {
  Given loop;
  const double x_m = loop.vehicle.position_enu_m.x();
  const MovingBodies ahead = somebody_at(Vec3(x_m + 1.6, 0, 0), Vec3::Zero(), loop.stamp_now_s());
  loop.extra.bodies = &ahead;
  loop.extra.bodies_at_s = loop.now_s;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kBody);
  const MovingBodies near = somebody_at(Vec3(x_m + 1.0, 0, 0), Vec3::Zero(), loop.stamp_now_s());
  loop.extra.bodies = &near;
  loop.run(0.15);
  EXPECT_EQ(loop.result.mode, SafetyMode::kBrake);
  EXPECT_EQ(loop.result.reason, SafetyReason::kBodyNear);
}

TEST(CheckPlan, TakesAPlanTooNearSomebodyIfNothingElseIsFarther) {
  Given loop;
  // Somebody walks up from behind, faster than the vehicle flies: to stand would be worse.
  const double x_m = loop.vehicle.position_enu_m.x();
  const MovingBodies behind =
      somebody_at(Vec3(x_m - 1.0, 0, 0), Vec3(0.9, 0, 0), loop.stamp_now_s());
  loop.extra.bodies = &behind;
  loop.extra.bodies_at_s = loop.now_s;
  const PlannedTrajectory on = loop.next_plan();
  EXPECT_EQ(loop.give(on), PlanFault::kNone);
  EXPECT_EQ(loop.result.mode, SafetyMode::kTrack);
  loop.flown_id = loop.result.plan_id;
  EXPECT_EQ(loop.give(still_plan(++loop.last_plan, loop.stamp_now_s() + 0.02,
                                 loop.vehicle.position_enu_m)),
            PlanFault::kBody);
}

TEST(CheckPlan, PeopleWhoWereHeardOfLongAgoAreNoneAndFarOnesDoNotMatter) {
  Given loop;
  const double x_m = loop.vehicle.position_enu_m.x();
  const MovingBodies ahead = somebody_at(Vec3(x_m + 1.6, 0, 0), Vec3::Zero(), loop.stamp_now_s());
  loop.extra.bodies = &ahead;
  loop.extra.bodies_at_s = loop.now_s - 5.0;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone);
  const MovingBodies far = somebody_at(Vec3(x_m + 6.0, 0, 0), Vec3::Zero(), loop.stamp_now_s());
  loop.extra.bodies = &far;
  loop.extra.bodies_at_s = loop.now_s;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone);
}

/// Nobody has seen what is from z on; what is from the ceiling on is occupied.
GridMap unseen_above(double z_m, double ceiling_m) {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const double height_m = map.center_of({x, y, z}).z();
        if (height_m <= z_m) continue;
        map.cells[map.offset_of({x, y, z})] =
            static_cast<std::uint8_t>(height_m > ceiling_m ? Cell::kOccupied : Cell::kUnknown);
      }
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

/// A vehicle that stands, and a plan that climbs.
struct Climbs : Given {
  Climbs() {
    run(4.0);
    flown_id = result.plan_id;
  }
  PlannedTrajectory plan() {
    PlannedTrajectory up = still_plan(++last_plan, stamp_now_s() + 0.02, vehicle.position_enu_m);
    up.pieces[0].coefficients.col(2).tail(3) = 0.7 * Vec3(10.0, -15.0, 6.0);
    return up;
  }
  MovingBodies walker(double distance_m, double speed_m_s) const {
    return somebody_at({vehicle.position_enu_m.x() + distance_m, 0.0, 0.0}, {-speed_m_s, 0.0, 0.0},
                       stamp_now_s());
  }
};

TEST(CheckPlan, IntoTheUnseenOnlyFromSomebodyWhoWouldWalkIntoTheVehicle) {
  const GridMap unseen = unseen_above(2.0, 9.0), ceiling = unseen_above(2.0, 2.3);
  const auto climbing = [](const GridMap& map, double distance_m, double speed_m_s) {
    Climbs loop;
    loop.extra.map = &map;
    const MovingBodies bodies = loop.walker(distance_m, speed_m_s);
    loop.extra.bodies = &bodies;
    loop.extra.bodies_at_s = loop.now_s;
    return loop.give(loop.plan());
  };
  EXPECT_EQ(climbing(open_map(), 5.0, 0.0), PlanFault::kNone);
  EXPECT_EQ(climbing(unseen, 5.0, 0.0), PlanFault::kObstacle) << "nobody comes";
  EXPECT_EQ(climbing(unseen, 1.8, 1.5), PlanFault::kNone) << "somebody comes";
  EXPECT_EQ(climbing(ceiling, 1.8, 1.5), PlanFault::kObstacle) << "it is known to be closed";
  EXPECT_EQ(climbing(unseen, 0.4, 1.5), PlanFault::kObstacle) << "too late: it is no farther away";
}

TEST(CheckPlan, WhatIsFlownGoesOnIntoTheUnseenWhileAStopWouldBeWalkedInto) {
  Climbs loop;
  const GridMap unseen = unseen_above(2.0, 9.0);
  loop.extra.map = &unseen;
  MovingBodies bodies = loop.walker(1.8, 1.5);
  loop.extra.bodies = &bodies;
  loop.extra.bodies_at_s = loop.now_s;
  ASSERT_EQ(loop.give(loop.plan()), PlanFault::kNone);
  double climb_m_s = 0.0;
  do {
    climb_m_s = loop.vehicle.velocity_enu_m_s.z();
    loop.extra.bodies_at_s = loop.now_s;
  } while (loop.tick().mode != SafetyMode::kBrake && loop.vehicle.position_enu_m.z() < 2.2);
  const double stop_z_m = loop.vehicle.position_enu_m.z() + climb_m_s * climb_m_s / (2.0 * 3.0);
  EXPECT_GT(stop_z_m, 2.2 - 0.1) << "it brakes once a stop leads as high as the plan";
  Climbs alone;
  ASSERT_EQ(alone.give(alone.plan()), PlanFault::kNone);
  alone.extra.map = &unseen;
  alone.run(0.15);
  EXPECT_EQ(alone.result.reason, SafetyReason::kPlanBlocked);
}

FlightBounds fence_to(double x_m) {
  FlightBounds bounds;
  bounds.corner_count = 4;
  bounds.corners_enu_m = {{{-5, -5}, {x_m, -5}, {x_m, 5}, {-5, 5}}};
  return bounds;
}

TEST(CheckPlan, RefusesAPlanThatLeavesTheFenceOrTheAltitudes) {
  Given loop;
  loop.state.mission.bounds = fence_to(1.0);
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kBounds);
  Given low;
  low.params.altitude_max_m = 1.7;
  EXPECT_EQ(low.give(low.next_plan()), PlanFault::kNone) << "it begins there, and stays";
  low.flown_id = low.result.plan_id;
  PlannedTrajectory up =
      still_plan(++low.last_plan, low.stamp_now_s() + 0.02, low.vehicle.position_enu_m);
  up.pieces[0].coefficients.col(2).tail(3) = 0.3 * Vec3(10.0, -15.0, 6.0);  // by 0.3 m
  EXPECT_EQ(low.give(up), PlanFault::kBounds);
}

/// Ground that is that much higher from x on.
GridMap step_at(double x_m, double height_m) {
  GridMap map = open_map();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const Vec3 center = map.center_of({x, y, z});
        if (center.x() > x_m && center.z() < height_m)
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
      }
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

TEST(CheckPlan, RefusesAPlanThatLeadsTooLowOverTheGroundBelow) {
  Given loop;
  const GridMap low = step_at(1.0, 0.5), high = step_at(1.0, 1.0);
  loop.extra.map = &low;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kNone);
  loop.flown_id = loop.result.plan_id;
  loop.extra.map = &high;
  EXPECT_EQ(loop.give(loop.next_plan()), PlanFault::kBounds);
}

TEST(CheckPlan, BrakesWhereWhatIsFlownLeavesTheFence) {
  Given loop;
  loop.state.mission.bounds = fence_to(0.8);
  while (loop.result.mode == SafetyMode::kTrack || loop.result.mode == SafetyMode::kCoast)
    loop.tick();
  EXPECT_EQ(loop.result.mode, SafetyMode::kBrake);
  EXPECT_EQ(loop.result.reason, SafetyReason::kFence);
  EXPECT_LT(loop.vehicle.position_enu_m.x(), 0.8);
}

TEST(CheckPlan, TheNextPlanMayContinueTheOneThatWaits) {
  Given loop;
  const double x_m = loop.state.flown.position(loop.now_s + 0.06 - loop.state.flown.start_s).x();
  const PlannedTrajectory second = straight_plan(++loop.last_plan, loop.stamp_now_s() + 0.06, x_m);
  const PlannedTrajectory third =
      straight_plan(++loop.last_plan, second.start_s + 0.03, second.position(0.03).x());
  loop.tick(&second);
  EXPECT_EQ(loop.tick(&third).refusal, PlanFault::kNone);
}

TEST(CheckPlan, AnEmptyPlanAndTheOneThatIsFlownAreSignsOfLifeAlone) {
  Given loop;
  PlannedTrajectory same = loop.state.flown;
  same.start_s += loop.clock_offset_s;
  EXPECT_EQ(loop.tick(&same).refusal, PlanFault::kNone);
  PlannedTrajectory none;
  EXPECT_EQ(loop.tick(&none).refusal, PlanFault::kNone);
  EXPECT_EQ(loop.result.plan_id, loop.flown_id);
  EXPECT_LT(loop.result.plan_age_s, 0.005);
}

}  // namespace
}  // namespace foretrack::testing
