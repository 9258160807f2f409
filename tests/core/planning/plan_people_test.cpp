// SPDX-License-Identifier: Apache-2.0
// What is flown keeps clear of people: closed loop with an ideal vehicle, gaps measured in space.
#include <gtest/gtest.h>

#include <functional>

#include "core/planning/plan.hpp"
#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using Walk = std::function<Vec3(double)>;  // where the feet are at a time

// How far somebody has walked who changes the speed at 3 m/s², as people do, from one to another.
double walked_m(double t_s, double from_m_s, double to_m_s) {
  constexpr double kAcceleration_m_s2 = 3.0;
  if (t_s <= 0.0) return from_m_s * t_s;
  const double change_s = std::abs(to_m_s - from_m_s) / kAcceleration_m_s2;
  const double changing_s = std::min(t_s, change_s);
  const double a = std::copysign(kAcceleration_m_s2, to_m_s - from_m_s);
  return from_m_s * changing_s + 0.5 * a * changing_s * changing_s + to_m_s * (t_s - changing_s);
}

Vec3 velocity_of(const Walk& walk, double now_s) {
  return (walk(now_s) - walk(now_s - 1e-3)) / 1e-3;
}

struct Outcome {
  double least_gap_m = 1e9, least_bystander_gap_m = 1e9, least_clearance_m = 1e9;
  double highest_m = 0.0, worst_distance_m = 0.0;
  PlannedTrajectory last;
};

// The target is seen 0.1 s late, as going on straight.
Outcome fly(const World& world, const Vec3& start, const Walk& target, double duration_s,
            const std::vector<Walk>& bystanders = {}) {
  constexpr double kPeriod_s = 0.05, kDelay_s = 0.1, kHull_m = 0.25;
  const GridMap map = known_map(world, 0.15);
  const PlanningParams params;
  PlanningState state;
  VehicleState vehicle = testing::hovering(start, 0.0, 0.0);
  Outcome out;
  for (double now_s = 0.0; now_s < duration_s; now_s += kPeriod_s) {
    PlanInput input;
    input.now_s = now_s;
    input.vehicle = vehicle;
    input.map = &map;
    input.target.status = TrackStatus::kTracking;
    input.target.stamp_s = now_s;
    input.target.velocity_enu_m_s = velocity_of(target, now_s - kDelay_s);
    input.target.position_enu_m =
        target(now_s - kDelay_s) + Vec3(0.0, 0.0, 1.2) + kDelay_s * input.target.velocity_enu_m_s;
    MovingBodies bodies;
    bodies.stamp_s = now_s;
    for (const Walk& walk : bystanders) {
      MovingBody body;
      body.stamp_s = now_s;
      body.velocity_enu_m_s = velocity_of(walk, now_s - kDelay_s);
      body.position_enu_m = walk(now_s - kDelay_s) + kDelay_s * body.velocity_enu_m_s;
      bodies.add(body);
    }
    input.bodies = &bodies;
    out.last = plan(state, input, params).trajectory;
    for (double ahead_s = 0.01; ahead_s < kPeriod_s + 1e-9; ahead_s += 0.01) {
      const Vec3 p = testing::state_on(out.last, now_s + ahead_s).position_enu_m;
      if (now_s + ahead_s < out.last.start_s) continue;
      const auto gap = [&](const Walk& walk) {
        return gap_m(p, kHull_m, walk(now_s + ahead_s), 0.25, 1.75);
      };
      out.least_gap_m = std::min(out.least_gap_m, gap(target));
      for (const Walk& walk : bystanders)
        out.least_bystander_gap_m = std::min(out.least_bystander_gap_m, gap(walk));
      out.least_clearance_m = std::min(out.least_clearance_m, clearance_m(world, p));
      out.highest_m = std::max(out.highest_m, p.z());
      out.worst_distance_m = std::max(out.worst_distance_m, distance_xy(p, target(now_s)));
    }
    vehicle = testing::state_on(out.last, now_s + kPeriod_s);
  }
  return out;
}

// A corridor along x, closed at its west end.
World dead_end(double width_m) {
  World world = testing::empty_world(10.0);
  world.max_m.z() = 5.0;
  const double half_m = 0.5 * width_m;
  world.boxes.push_back({{-6.4, half_m, 0.0}, {9.0, half_m + 0.4, 4.0}});
  world.boxes.push_back({{-6.4, -half_m - 0.4, 0.0}, {9.0, -half_m, 4.0}});
  world.boxes.push_back({{-6.4, -half_m, 0.0}, {-6.0, half_m, 4.0}});
  return world;
}

class HeadOn : public ::testing::TestWithParam<std::pair<double, double>> {};  // width, speed

TEST_P(HeadOn, InADeadEndTheVehicleGetsOutOfThePersonsWay) {
  const auto [width_m, speed_m_s] = GetParam();
  const Walk walk = [speed_m_s](double t) {
    return Vec3(std::max(4.0 - walked_m(t - 1.0, 0.0, speed_m_s), -5.0), 0.0, 0.0);
  };
  const Outcome out = fly(dead_end(width_m), {1.5, 0.0, 1.3}, walk, 9.0);
  EXPECT_GE(out.least_gap_m, speed_m_s <= 1.5 ? 0.5 : 0.3);
  EXPECT_GT(out.least_clearance_m, 0.25);
}

INSTANTIATE_TEST_SUITE_P(WidthsAndSpeeds, HeadOn,
                         ::testing::Values(std::pair(1.6, 1.0), std::pair(1.6, 1.5),
                                           std::pair(3.0, 1.5), std::pair(2.0, 2.0)));

TEST(PlanPeople, BacksOffBeforeSomebodyWhoTurnsBackInACorridor) {
  const Walk walk = [](double t) { return Vec3(3.0 + walked_m(t - 4.0, 1.5, -1.5), 0.0, 0.0); };
  const Outcome out = fly(dead_end(1.6), {-5.0, 0.0, 1.3}, walk, 8.0);
  EXPECT_GE(out.least_gap_m, 0.5);
}

TEST(PlanPeople, KeepsClearOfSomebodyWhoCrossesTheWay) {
  const Walk target = [](double t) { return Vec3(-2.0 + 1.0 * t, 0.0, 0.0); };
  for (const double speed_m_s : {1.0, 2.0, 3.0}) {
    // Would meet the vehicle, which is 2 m behind the target.
    const Walk crosses = [speed_m_s](double t) { return Vec3(0.0, speed_m_s * (t - 4.0), 0.0); };
    const Outcome out = fly(testing::empty_world(10.0), {-4.0, 0.0, 1.3}, target, 8.0, {crosses});
    EXPECT_GE(out.least_bystander_gap_m, speed_m_s <= 1.5   ? 0.5
                                         : speed_m_s <= 2.0 ? 0.3
                                                            : 0.0)
        << speed_m_s;
    EXPECT_LT(out.worst_distance_m, 4.5) << speed_m_s;  // and goes on following
  }
}

TEST(PlanPeople, GoesOnFollowingBesideSomebodyWhoStands) {
  const Walk target = [](double t) { return Vec3(-2.0 + 1.5 * t, 0.0, 0.0); };
  const Walk stands = [](double) { return Vec3(1.0, 0.9, 0.0); };
  const Outcome out = fly(testing::empty_world(10.0), {-4.0, 0.0, 1.3}, target, 6.0, {stands});
  EXPECT_GE(out.least_bystander_gap_m, 0.5);
  EXPECT_LT(out.worst_distance_m, 3.5);
  EXPECT_EQ(out.last.status, PlanStatus::kFresh);
}

// A thin bar across a wall's opening, at flight height: neither vehicle nor target is near it.
TEST(PlanPeople, FliesOverABarThatLiesAcrossTheWayAtFlightHeight) {
  World world = testing::empty_world(8.0);
  world.boxes.push_back({{0.0, -8.0, 1.3}, {0.05, 8.0, 1.35}});
  const Walk target = [](double t) { return Vec3(-1.0 + std::min(t, 6.0), 0.0, 0.0); };
  const Outcome out = fly(world, {-3.0, 0.0, 1.3}, target, 14.0);
  EXPECT_GT(out.least_clearance_m, 0.25);
  EXPECT_GT(out.last.position(out.last.duration_s()).x(), 1.0);
}

}  // namespace
}  // namespace foretrack
