// SPDX-License-Identifier: Apache-2.0
// Who walks by is known to the tracker, in lock-step with the simulator.
#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"
#include "core/tracker/tracker.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

/// A vehicle that hovers and looks at a person who stands, while somebody crosses between them.
struct Crossing {
  Scenario scenario;
  TrackerParams params;
  std::optional<TrackerState> tracker;
  std::optional<SimulatorState> simulator;
  TrackerOutput out;

  explicit Crossing(double speed_m_s, MapSource map) {
    scenario.world.min_m = {-10, -10, 0};
    scenario.world.max_m = {10, 10, 5};
    scenario.target.route_m = {{3.0, 0.0}, {3.1, 0.0}};
    scenario.target.person.start_s = 100.0;
    scenario.vehicle_enu_m = Vec3(-1.0, 0.0, 1.5);
    BystanderSpec walker;
    walker.route_m = {{1.2, -6.0}, {1.2, 6.0}};
    walker.speed_m_s = speed_m_s;
    walker.walk.start_s = 1.0;
    scenario.bystanders = {walker};
    scenario.map = map;
    simulator = make_simulator(scenario);
    tracker.emplace(params);
  }
  double walker_y() const { return simulator->bystanders[0].state.position_enu_m.y(); }
  /// Well within the angle of view.
  bool in_view() const { return std::abs(walker_y()) < 1.5; }
  const MovingBody* walker_in(const MovingBodies& bodies) const {
    const Vec2 truth = simulator->bystanders[0].state.position_enu_m.head<2>();
    for (const MovingBody& body : bodies.all())
      if (!body.followed && (body.position_enu_m.head<2>() - truth).norm() < 0.5) return &body;
    return nullptr;
  }
  void tick(const GridMap* known) {
    const SimulatorOutput& seen = simulate(*simulator, {}, kStep_s);
    TrackerInput input{.now_s = seen.now_s,
                       .vehicle = seen.vehicle,
                       .autopilot = seen.autopilot,
                       .observation = seen.observation ? &*seen.observation : nullptr,
                       .depth = known ? nullptr : seen.depth,
                       .known_map = known};
    if (known && seen.sightings) input.sightings = &*seen.sightings;
    out = step(*tracker, input, params);
  }
};

class WhoWalksBy : public ::testing::TestWithParam<std::pair<double, MapSource>> {};

TEST_P(WhoWalksBy, IsKnownInTimeByPlaceAndVelocity) {
  const auto [speed_m_s, map] = GetParam();
  Crossing crossing(speed_m_s, map);
  const GridMap known = known_map(crossing.simulator->world, 0.15);
  double in_view_s = 0.0, known_s = 0.0, first_s = -1.0, worst_m_s = 0.0;
  while (crossing.walker_y() < 5.5 && crossing.simulator->output.now_s < 16.0) {
    crossing.tick(map == MapSource::kKnown ? &known : nullptr);
    ASSERT_NE(crossing.out.bodies, nullptr);
    if (!crossing.in_view()) continue;
    in_view_s += kStep_s;
    const MovingBody* body = crossing.walker_in(*crossing.out.bodies);
    if (!body) continue;
    if (first_s < 0.0) first_s = in_view_s;
    known_s += kStep_s;
    if (in_view_s > first_s + 0.3)
      worst_m_s =
          std::max(worst_m_s, (body->velocity_enu_m_s.head<2>() - Vec2(0.0, speed_m_s)).norm());
  }
  EXPECT_GT(first_s, 0.0);
  EXPECT_LT(first_s, 0.5);
  EXPECT_GT(known_s, 0.95 * (in_view_s - first_s));
  EXPECT_LT(worst_m_s, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Speeds, WhoWalksBy,
                         ::testing::Values(std::pair(1.0, MapSource::kDepth),
                                           std::pair(2.0, MapSource::kDepth),
                                           std::pair(3.0, MapSource::kDepth),
                                           std::pair(1.0, MapSource::kKnown),
                                           std::pair(3.0, MapSource::kKnown)));

TEST(Surroundings, NobodyLeavesAGhostInTheMap) {
  Crossing crossing(1.2, MapSource::kDepth);
  while (crossing.walker_y() < 5.5) crossing.tick(nullptr);
  const GridMap& map = *crossing.out.map;
  int ghosts = 0;
  for (double y = -1.8; y < 1.8; y += 0.15)
    for (double x = 0.75; x < 3.6; x += 0.15)
      for (double z = 0.4; z < 1.8; z += 0.15) ghosts += map.is_occupied({x, y, z});
  EXPECT_EQ(ghosts, 0) << "of who crossed, or of the person who is followed";
}

TEST(Surroundings, TheFollowedPersonComesFirstAndNobodyElseIsThere) {
  Crossing crossing(1.2, MapSource::kDepth);
  for (int k = 0; k < 100; ++k) crossing.tick(nullptr);  // before the walker sets off
  ASSERT_EQ(crossing.out.bodies->count, 1);
  const MovingBody& person = crossing.out.bodies->bodies[0];
  EXPECT_TRUE(person.followed);
  EXPECT_LT((person.position_enu_m - Vec3(3.0, 0.0, 0.0)).norm(), 0.25);
  EXPECT_GT(person.place_count, 0);
}

}  // namespace
}  // namespace foretrack
