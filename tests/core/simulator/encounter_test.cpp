// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/encounter.hpp"

#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"

namespace foretrack {
namespace {

constexpr double kSpeeds_m_s[] = {0.5, 1.0, 1.5, 2.0, 3.0};

Scenario staged(EncounterKind kind, double speed_m_s, std::uint64_t seed) {
  Scenario scenario;
  scenario.target.speed_m_s = speed_m_s;
  scenario.duration_s = 12.0;
  scenario.seed = seed;
  stage_encounter(kind, scenario);
  return scenario;
}

template <class Check>
void for_all(Check check) {
  for (std::size_t kind = 0; kind < kEncounterKindNames.size(); ++kind)
    for (const double speed_m_s : kSpeeds_m_s)
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(::testing::Message()
                     << kEncounterKindNames[kind] << " " << speed_m_s << " " << seed);
        check(staged(static_cast<EncounterKind>(kind), speed_m_s, seed), speed_m_s);
      }
}

bool walks_clear(const World& world, const std::vector<Vec2>& route_m) {
  for (std::size_t i = 0; i + 1 < route_m.size(); ++i)
    if (ground_clearance_m(world, route_m[i], route_m[i + 1]) < kPersonRadius_m) return false;
  return true;
}

TEST(Encounter, EverySceneCanBeFlownAndNobodyWalksThroughWalls) {
  for_all([](const Scenario& s, double) {
    EXPECT_NO_THROW(make_simulator(s));
    EXPECT_TRUE(walks_clear(s.world, s.target.route_m));
    for (const BystanderSpec& b : s.bystanders) EXPECT_TRUE(walks_clear(s.world, b.route_m));
  });
}

TEST(Encounter, NobodyWalksThroughTheFollowedPerson) {
  for (const auto kind : {EncounterKind::kHeadOn, EncounterKind::kTowards})
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      SimulatorState state = make_simulator(staged(kind, 1.5, seed));
      double nearest_m = 1e9;
      while (state.output.now_s < 8.0) {
        const SimulatorOutput& out = simulate(state, {}, 0.01);
        for (const Person& b : out.bystanders)
          nearest_m =
              std::min(nearest_m, distance_xy(b.state.position_enu_m, out.target.position_enu_m));
      }
      EXPECT_GT(nearest_m, 0.4) << kEncounterKindNames[static_cast<std::size_t>(kind)] << seed;
    }
}

TEST(Encounter, ThoseWhoComeNearHaveTheSpeedThatWasAskedFor) {
  for_all([](const Scenario& s, double speed_m_s) {
    double fastest_m_s = s.target.speed_m_s;
    for (const BystanderSpec& b : s.bystanders) fastest_m_s = std::max(fastest_m_s, b.speed_m_s);
    EXPECT_EQ(fastest_m_s, speed_m_s);
    EXPECT_LE(s.bystanders.size(), 8u);
  });
}

TEST(Encounter, TheSeedDecidesPlaceAndPeople) {
  const Scenario a = staged(EncounterKind::kGroup, 1.5, 3),
                 b = staged(EncounterKind::kGroup, 1.5, 3);
  ASSERT_EQ(a.bystanders.size(), b.bystanders.size());
  EXPECT_EQ(a.bystanders[1].route_m, b.bystanders[1].route_m);
  std::array<int, kEncounterPlaceNames.size()> places{};
  std::array<int, 9> groups{};
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    ++places[static_cast<std::size_t>(
        staged(EncounterKind::kTurnBack, 1.5, seed).encounter->place)];
    ++groups[staged(EncounterKind::kGroup, 1.5, seed).bystanders.size()];
  }
  for (const int count : places) EXPECT_GT(count, 3);
  for (std::size_t n = 2; n <= 8; ++n) EXPECT_GT(groups[n], 0) << n;
}

// Where the vehicle will be if it follows as it should: 2 m behind.
TEST(Encounter, CrossersPassBeforeOrBehindTheVehicleThatFollows) {
  for (const auto& [kind, low_m, high_m] : {std::tuple{EncounterKind::kCrossBefore, 0.4, 1.5},
                                            std::tuple{EncounterKind::kCrossBehind, -1.5, -0.2}})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SimulatorState state = make_simulator(staged(kind, 1.5, seed));
      double ahead_m = 1e9, nearest_m = 1e9;
      while (state.output.now_s < 6.0) {
        const SimulatorOutput& out = simulate(state, {}, 0.01);
        const Vec3 followed = out.target.position_enu_m;
        const Vec2 apart =
            out.bystanders[0].state.position_enu_m.head<2>() - followed.head<2>() + Vec2(2, 0);
        if (std::abs(apart.y()) < nearest_m) nearest_m = std::abs(apart.y()), ahead_m = apart.x();
      }
      EXPECT_LT(nearest_m, 0.05) << seed;
      EXPECT_GT(ahead_m, low_m - 0.25) << seed;
      EXPECT_LT(ahead_m, high_m + 0.25) << seed;
    }
}

}  // namespace
}  // namespace foretrack
