// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/hiding.hpp"

#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"

namespace foretrack {
namespace {

template <class Check>
void for_all_hidings(Check check) {
  for (std::size_t kind = 0; kind < kHidingKindNames.size(); ++kind)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(::testing::Message() << kHidingKindNames[kind] << " " << seed);
      Scenario scenario;
      scenario.seed = seed;
      stage_hiding(static_cast<HidingKind>(kind), scenario);
      check(scenario);
    }
}

TEST(Hiding, EverySceneCanBeFlownAndNobodyWalksThroughWalls) {
  for_all_hidings([](const Scenario& s) {
    const World world = world_of(s);
    for (std::size_t i = 0; i + 1 < s.target.route_m.size(); ++i)
      EXPECT_GE(ground_clearance_m(world, s.target.route_m[i], s.target.route_m[i + 1]), 0.29);
    EXPECT_NO_THROW(make_simulator(s));
  });
}

TEST(Hiding, PeopleWalkAsTheyAreSaidToAndLongEnoughAfter) {
  for_all_hidings([](const Scenario& s) {
    EXPECT_GE(s.target.speed_m_s, 0.5);
    EXPECT_LE(s.target.speed_m_s, 1.5);
    const auto& route = s.target.route_m;
    const double after_m = (route.back() - route[route.size() - 2]).norm();
    EXPECT_GT(after_m / s.target.speed_m_s, 10.0);
  });
}

TEST(Hiding, TheSameSeedGivesTheSameScene) {
  Scenario a, b, other;
  a.seed = b.seed = 3;
  other.seed = 4;
  for (Scenario* s : {&a, &b, &other}) stage_hiding(HidingKind::kRooms, *s);
  EXPECT_EQ(a.target.route_m, b.target.route_m);
  EXPECT_EQ(a.duration_s, b.duration_s);
  EXPECT_NE(a.target.route_m, other.target.route_m);
}

}  // namespace
}  // namespace foretrack
