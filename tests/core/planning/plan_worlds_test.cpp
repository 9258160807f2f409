// SPDX-License-Identifier: Apache-2.0
// Many replans in closed loop among obstacles.
#include <gtest/gtest.h>

#include "tests/core/planning/plan_loop.hpp"

namespace foretrack {
namespace {

struct Tally {
  int replans = 0, not_fresh = 0, retried = 0;
};

Tally follow(const WorldGenerator& request, double speed_m_s, int replans) {
  constexpr double kTick_s = 0.02;
  constexpr int kTicksPerPlan = 5;
  const std::vector<Vec2> kept_free = {{0.0, 0.0}, {-2.5, 0.0}};
  const World world = generate_world(request, {-20.0, -20.0, 0.0}, {20.0, 20.0, 5.0}, kept_free);
  const GridMap map = known_map(world, 0.15);
  testing::Walker walker(world, Vec2::Zero(), speed_m_s, request.seed + 17);
  PlanningState planning;
  VehicleState vehicle = testing::hovering({-2.0, 0.0, 1.5}, 0.0, 0.0);
  Tally tally;
  for (int tick = 0; tick < replans * kTicksPerPlan; ++tick) {
    const double now_s = kTick_s * tick;
    const PlannedTrajectory& flown = planning.results[planning.flown].trajectory;
    vehicle.stamp_s = now_s;
    if (!flown.pieces.empty() && now_s >= flown.start_s) vehicle = testing::state_on(flown, now_s);
    if (tick % kTicksPerPlan == 0) {
      const PlanInput input{now_s, vehicle, walker.state(now_s), nullptr, nullptr, &map};
      const PlanResult& result = plan(planning, input, PlanningParams{});
      ++tally.replans;
      // A plan that is kept as the person comes too near is meant.
      tally.not_fresh +=
          result.trajectory.status != PlanStatus::kFresh && result.diagnostics.check.gaps.ok;
      tally.retried += result.diagnostics.attempts > 3;  // it braked first
    }
    walker.advance(kTick_s);
  }
  return tally;
}

TEST(PlanWorlds, AFastVehicleBesideASharpTurnBrakesFirstRatherThanFailing) {
  Tally all;
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
    for (const WorldGenerator& request : {WorldGenerator{WorldKind::kBlocks, 0, seed},
                                          WorldGenerator{WorldKind::kBoxes, 120, seed}}) {
      const Tally tally = follow(request, 1.5, 1000);
      all.replans += tally.replans;
      all.not_fresh += tally.not_fresh;
      all.retried += tally.retried;
    }
  EXPECT_EQ(all.replans, 4000);
  EXPECT_LE(all.not_fresh, 1);  // whose stop comes too near an obstacle itself
  EXPECT_GE(all.retried, 5);
}

}  // namespace
}  // namespace foretrack
