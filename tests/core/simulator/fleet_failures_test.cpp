// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/fleet_failures.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

const Vec3 kPlace(0, 0, 1.5), kFar(9, 0, 1.5), kBeside(2, 0, 1.0);

TEST(Presence, WhoJoinsWaitsForRoomFromVehiclesAndFromThePerson) {
  Scenario scenario;
  scenario.failures = {{.vehicle = "uav1", .at_s = 5.0, .kind = FleetFailureKind::kJoins}};
  Presence presence;
  const auto at = [&](double time_s, const Vec3& person, const Vec3& other) {
    presence.update(scenario, "uav1", time_s, kPlace, person, std::span(&other, 1));
    return presence.is_there();
  };
  EXPECT_FALSE(at(4.9, kFar, kFar)) << "it is not yet time";
  EXPECT_FALSE(at(5.1, kBeside, kFar));
  EXPECT_FALSE(at(5.2, kFar, kBeside));
  EXPECT_TRUE(at(5.3, kFar, kFar));
  EXPECT_TRUE(at(5.4, kBeside, kBeside)) << "it flies now";
  EXPECT_EQ(presence.joined_s(), 5.3);
}

TEST(Presence, WhoNeedNotJoinIsThereFromTheBeginUntilItDies) {
  Scenario scenario;
  scenario.failures = {{.vehicle = "uav2", .at_s = 5.0, .kind = FleetFailureKind::kDies}};
  Presence presence;
  for (const double time_s : {0.0, 4.9, 5.0}) {
    presence.update(scenario, "uav2", time_s, kPlace, kBeside, std::span(&kBeside, 1));
    EXPECT_EQ(presence.is_there(), time_s < 5.0);
  }
}

}  // namespace
}  // namespace foretrack
