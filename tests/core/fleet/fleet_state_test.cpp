// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_state.hpp"

#include <gtest/gtest.h>

#include <string>

namespace foretrack {
namespace {

FleetMember message(const std::string& vehicle, double stamp_s, double x_m = 0.0) {
  FleetMember m;
  m.vehicle = vehicle;
  m.stamp_s = stamp_s;
  m.position_enu_m.x() = x_m;
  return m;
}

TEST(Hear, TheNewestCountsInWhateverOrderTheyCome) {
  FleetState state;
  const FleetParams params;
  hear(state, message("b", 1.0, 1.0), 1.0, params);
  hear(state, message("b", 1.2, 2.0), 1.3, params);
  hear(state, message("b", 1.1, 3.0), 1.4, params);
  ASSERT_EQ(state.count, 1);
  EXPECT_EQ(state.peers[0].told.position_enu_m.x(), 2.0);
  EXPECT_EQ(state.peers[0].heard_s, 1.3);
}

TEST(Hear, KeepsThemSortedByName) {
  FleetState state;
  for (const char* name : {"c", "a", "b", "a"}) hear(state, message(name, 1.0), 1.0, {});
  ASSERT_EQ(state.count, 3);
  EXPECT_EQ(state.peers[0].told.vehicle.view(), "a");
  EXPECT_EQ(state.peers[1].told.vehicle.view(), "b");
  EXPECT_EQ(state.peers[2].told.vehicle.view(), "c");
}

TEST(Hear, WhoBeganAnewWithAnEarlierClockIsHeardAfterItsSilence) {
  FleetState state;
  const FleetParams params;
  hear(state, message("b", 100.0), 1.0, params);
  hear(state, message("b", 5.0, 7.0), 1.5, params);
  EXPECT_EQ(state.peers[0].told.stamp_s, 100.0) << "not silent yet";
  hear(state, message("b", 5.5, 8.0), 1.1 + params.silent_s, params);
  EXPECT_EQ(state.peers[0].told.position_enu_m.x(), 8.0);
}

TEST(Hear, LeavesOutWhomThereIsNoRoomFor) {
  FleetState state;
  for (int i = 0; i < 40; ++i) hear(state, message("v" + std::to_string(100 + i), 1.0), 1.0, {});
  EXPECT_EQ(state.count, kFleetCapacity - 1);
  EXPECT_EQ(state.peers[0].told.vehicle.view(), "v100");
}

TEST(Forget, WhoWasNotHeardForLongIsGone) {
  FleetState state;
  const FleetParams params;
  hear(state, message("a", 1.0), 1.0, params);
  hear(state, message("b", 1.0), 5.0, params);
  forget(state, 1.5 + params.forget_s, params);
  ASSERT_EQ(state.count, 1);
  EXPECT_EQ(state.peers[0].told.vehicle.view(), "b");
}

}  // namespace
}  // namespace foretrack
