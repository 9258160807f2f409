// SPDX-License-Identifier: Apache-2.0
#include "core/planning/evade.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/planning/motion/stop_tail.hpp"
#include "tests/core/planning/one_plan.hpp"

namespace foretrack {
namespace {

using testing::OnePlan;

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

double gap_cost(OnePlan& one, const PlannedTrajectory& trajectory) {
  return measure_gaps(trajectory, 0.0, one.state.courses, one.params.limits, one.params.body).cost;
}

// Somebody walks at a vehicle that hovers.
struct WalkedAt : OnePlan {
  WalkedAt() { add_body({0.2, 0.0, 0.0}, {-1.5, 0.0, 0.0}); }
};

TEST(Evade, ComesToRestFartherFromWhoWalksAtItThanStandingDoes) {
  WalkedAt one;
  const PlanTask task = one.task();
  const auto result = evade(one.state, task, kAnyCost);
  ASSERT_TRUE(result);
  const PlannedTrajectory& evading = one.state.evading;
  EXPECT_LT(testing::end_speed_m_s(evading), 1e-6);
  EXPECT_EQ(evading.start_s, task.start.time_s);
  PlannedTrajectory standing;
  standing.start_s = task.start.time_s;
  standing.pieces = {make_stop_tail(task.start.state, task.limits).piece};
  EXPECT_LT(gap_cost(one, evading), 0.5 * gap_cost(one, standing));
}

TEST(Evade, KeepsTheLimitsAndTheWalls) {
  OnePlan one;
  one.world.boxes.push_back({{-9.0, 0.8, 0.0}, {9.0, 1.1, 4.0}});
  one.world.boxes.push_back({{-9.0, -1.1, 0.0}, {9.0, -0.8, 4.0}});
  one.build_map();
  one.add_body({0.2, 0.0, 0.0}, {-1.5, 0.0, 0.0});
  ASSERT_TRUE(evade(one.state, one.task(), kAnyCost));
  const PlannedTrajectory& evading = one.state.evading;
  for (double t = 0.0; t < evading.duration_s(); t += 0.02) {
    EXPECT_LE(evading.velocity(t).norm(), one.params.limits.speed_max_m_s);
    EXPECT_LE(evading.acceleration(t).norm(), one.params.limits.acceleration_max_m_s2);
    EXPECT_GE(one.map.unfree_distance_m(evading.position(t)),
              one.params.check.vehicle_radius_m - 1e-9);
  }
}

TEST(Evade, DoesNothingThatIsNotBetterThanWhatThereIs) {
  WalkedAt one;
  const PlanTask task = one.task();
  EXPECT_FALSE(evade(one.state, task, 0.0));
  ASSERT_TRUE(evade(one.state, task, kAnyCost));
  EXPECT_FALSE(evade(one.state, task, 0.9 * gap_cost(one, one.state.evading)));
}

TEST(Evade, WithNobodyNearItStaysWhereItIs) {
  OnePlan one;
  one.input.target.position_enu_m.x() = 6.0;
  ASSERT_TRUE(evade(one.state, one.task(), kAnyCost));
  const PlannedTrajectory& evading = one.state.evading;
  EXPECT_LT((evading.position(evading.duration_s()) - one.input.vehicle.position_enu_m).norm(),
            0.05);
}

}  // namespace
}  // namespace foretrack
