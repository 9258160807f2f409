// SPDX-License-Identifier: Apache-2.0
#include "core/planning/fall_back.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

constexpr PlanReason kWhy = PlanReason::kEmptyCorridor;

TEST(FallBack, WhatIsFlownFliesOnWhileItIsClear) {
  OnePlan one;
  one.fly();
  const std::uint64_t id = one.state.flown_result().trajectory.id;
  one.wait(0.3);
  const PlanResult& result = fall_back(one.state, one.task(), kWhy, one.clock);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kKept);
  EXPECT_EQ(result.trajectory.reason, kWhy);
  EXPECT_EQ(result.trajectory.id, id);
}

TEST(FallBack, OnceItStandsItHolds) {
  OnePlan one;
  one.fly();
  one.wait(one.state.flown_result().trajectory.duration_s() + 0.1);
  const PlanResult& result = fall_back(one.state, one.task(), kWhy, one.clock);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kHold);
}

TEST(FallBack, WithNothingFlownItStandsWhereItIs) {
  OnePlan one;
  const PlanResult& result = fall_back(one.state, one.task(), kWhy, one.clock);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kHold);
  EXPECT_EQ(result.trajectory.id, 1u);
  const Vec3 end = result.trajectory.position(result.trajectory.duration_s());
  EXPECT_LT((end - one.input.vehicle.position_enu_m).norm(), 0.01);
}

TEST(FallBack, AWallThatAppearsOnTheWayIsBrakedFor) {
  OnePlan one;
  one.fly();
  const PlannedTrajectory flown = one.state.flown_result().trajectory;
  one.wait(0.6);
  const double ahead_m = one.input.vehicle.position_enu_m.x() + 0.7;
  ASSERT_GT(flown.position(flown.duration_s()).x(), ahead_m) << "it flies there";
  one.world.boxes.push_back({{ahead_m, -9.0, 0.0}, {ahead_m + 0.3, 9.0, 4.0}});
  one.build_map();
  const PlanResult& result = fall_back(one.state, one.task(), kWhy, one.clock);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kHold);
  EXPECT_GT(result.trajectory.id, flown.id);
  EXPECT_LT(testing::end_speed_m_s(result.trajectory), 1e-6);
  const Vec3 end = result.trajectory.position(result.trajectory.duration_s());
  EXPECT_LT(end.x(), ahead_m - 0.1);
}

TEST(FallBack, SomebodyWhoWalksIntoWhatIsFlownIsEvaded) {
  OnePlan one;
  one.fly();
  one.wait(0.2);
  one.add_body({-0.6, 0.0, 0.0}, {-1.5, 0.0, 0.0});
  const PlanTask task = one.task();
  const PlannedTrajectory flown = one.state.flown_result().trajectory;
  const double kept = measure_gaps(flown, task.start.time_s - flown.start_s, one.state.courses,
                                   task.limits, one.params.body)
                          .cost;
  ASSERT_GT(kept, 0.0);
  const PlanResult& result = fall_back(one.state, task, kWhy, one.clock);
  EXPECT_GT(result.trajectory.id, flown.id);
  EXPECT_EQ(result.trajectory.reason, kWhy);
  EXPECT_LT(
      measure_gaps(result.trajectory, 0.0, one.state.courses, task.limits, one.params.body).cost,
      0.8 * kept);
}

// Somebody walks along an alley at a vehicle that hovers before its end; what is above is unseen.
struct DeadEnd : OnePlan {
  DeadEnd() {
    world.boxes.push_back({{-9.0, 0.55, 0.0}, {9.0, 0.85, 4.0}});
    world.boxes.push_back({{-9.0, -0.85, 0.0}, {9.0, -0.55, 4.0}});
    world.boxes.push_back({{-2.9, -0.85, 0.0}, {-2.6, 0.85, 4.0}});
    build_map();
    add_body({-0.2, 0.0, 0.0}, {-1.5, 0.0, 0.0});
  }
  void hide_above(double z_m, Cell cell) {
    for (int z = map.index_of({0.0, 0.0, z_m}).z(); z < map.size.z(); ++z)
      for (int y = 0; y < map.size.y(); ++y)
        for (int x = 0; x < map.size.x(); ++x)
          map.cells[map.offset_of({x, y, z})] = static_cast<std::uint8_t>(cell);
    DistanceWorkspace workspace;
    update_distances(map, workspace);
  }
  double least_gap_m() {
    fall_back(state, task(), kWhy, clock);
    return measure_gaps(state.flown_result().trajectory, 0.0, state.courses, params.limits,
                        params.body)
        .least_m;
  }
};

TEST(FallBack, WhereEverySeenWayWouldMeetSomebodyItFleesIntoTheUnseen) {
  DeadEnd open, hidden, closed;
  hidden.hide_above(1.9, Cell::kUnknown);
  closed.hide_above(1.9, Cell::kOccupied);
  EXPECT_GT(open.least_gap_m(), 0.2);
  EXPECT_EQ(open.state.flown_through, Passable::kSeenFree);
  EXPECT_GT(hidden.least_gap_m(), 0.2);
  EXPECT_EQ(hidden.state.flown_through, Passable::kNotOccupied);
  EXPECT_LT(closed.least_gap_m(), 0.2);
  EXPECT_EQ(closed.state.flown_through, Passable::kSeenFree);
}

TEST(FallBack, WhatFleesIntoTheUnseenGoesOnWithIt) {
  DeadEnd hidden;
  hidden.hide_above(1.9, Cell::kUnknown);
  ASSERT_GT(hidden.least_gap_m(), 0.2);
  for (int i = 0; i < 5; ++i) {
    hidden.wait(0.1);
    hidden.bodies.bodies[0].position_enu_m.x() -= 0.15;
    hidden.bodies.bodies[0].stamp_s = hidden.bodies.stamp_s = hidden.input.now_s;
    fall_back(hidden.state, hidden.task(), kWhy, hidden.clock);
  }
  EXPECT_GT(hidden.input.vehicle.position_enu_m.z(), 1.5) << "from 1.3 m";
  const PlannedTrajectory& t = hidden.state.flown_result().trajectory;
  EXPECT_GT(t.position(t.duration_s()).z(), 1.75 + 0.25) << "clear of who walks below";
}

TEST(FallBack, AStopIsTheNextCandidateAndEndsAtRest) {
  OnePlan one;
  one.fly();
  one.wait(0.5);
  EXPECT_EQ(try_stop(one.state, one.task(), one.clock), PlanReason::kOk);
  const PlannedTrajectory& stop = one.state.next_result().trajectory;
  EXPECT_EQ(stop.pieces.size(), 1u);
  EXPECT_EQ(stop.tail_start_s, 0.0);
  EXPECT_LT(testing::end_speed_m_s(stop), 1e-6);
  EXPECT_LT((stop.velocity(0.0) - one.input.vehicle.velocity_enu_m_s).norm(), 0.2);
}

TEST(FallBack, InputsThatDecideNothingLeaveWhatIsFlown) {
  OnePlan one;
  EXPECT_EQ(refuse(one.state).trajectory.id, 0u);
  one.fly();
  const PlanResult& result = refuse(one.state);
  EXPECT_EQ(result.trajectory.id, 1u);
  EXPECT_EQ(result.trajectory.status, PlanStatus::kKept);
  EXPECT_EQ(result.trajectory.reason, PlanReason::kStaleInput);
}

}  // namespace
}  // namespace foretrack
