// SPDX-License-Identifier: Apache-2.0
#include "core/safety/mission.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr MissionRules kRules{.max_age_s = 1.0, .lease_s = 5.0};

/// A mission that tracks, and orders with growing ids.
struct Orders {
  Mission mission{.phase = MissionPhase::kTracking, .lease = {}, .last_id = 0};
  double now_s = 100.0;
  std::uint64_t id = 0;

  MissionResult give(MissionOrder order, const std::string& name = "ada") {
    return apply({++id, now_s, order, name, name + "'s lease"}, mission, now_s, kRules);
  }
};

TEST(Mission, AnybodyMayOrderWhileNobodyHoldsTheLease) {
  Orders orders;
  EXPECT_EQ(orders.give(MissionOrder::kHold, "ada"), MissionResult::kAccepted);
  EXPECT_EQ(orders.give(MissionOrder::kResume, "bob"), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
}

TEST(Mission, RefusesEveryOrderOfOthersButStopWhileTheLeaseIsHeld) {
  for (const auto order :
       {MissionOrder::kStart, MissionOrder::kHold, MissionOrder::kResume, MissionOrder::kReturn,
        MissionOrder::kLand, MissionOrder::kLease, MissionOrder::kRelease}) {
    Orders orders;
    ASSERT_EQ(orders.give(MissionOrder::kLease, "ada"), MissionResult::kAccepted);
    EXPECT_EQ(orders.give(order, "bob"), MissionResult::kRefusedForeign) << to_string(order);
    EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
    EXPECT_EQ(orders.mission.lease.operator_name, "ada");
  }
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  EXPECT_EQ(orders.give(MissionOrder::kStop, "bob"), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.phase, MissionPhase::kStopped);
}

TEST(Mission, ALeaseRunsOutUnlessItIsRenewed) {
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  orders.now_s += 4.0;
  EXPECT_EQ(orders.give(MissionOrder::kLease, "ada"), MissionResult::kAccepted);
  orders.now_s += 4.0;
  EXPECT_EQ(orders.give(MissionOrder::kLease, "bob"), MissionResult::kRefusedForeign);
  orders.now_s += 1.5;
  EXPECT_EQ(orders.give(MissionOrder::kLease, "bob"), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.lease.operator_name, "bob");
}

TEST(Mission, AReleasedVehicleCanBeTakenAtOnce) {
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  EXPECT_EQ(orders.give(MissionOrder::kRelease, "ada"), MissionResult::kAccepted);
  EXPECT_FALSE(orders.mission.lease.is_held(orders.now_s));
  EXPECT_EQ(orders.give(MissionOrder::kLease, "bob"), MissionResult::kAccepted);
}

TEST(Mission, ALeaseWithoutASecretIsRefused) {
  Mission mission;
  const MissionCommand command{1, 0.0, MissionOrder::kLease, "ada", ""};
  EXPECT_EQ(apply(command, mission, 0.0, kRules), MissionResult::kRefusedForeign);
}

TEST(Mission, AStrangersHighIdDoesNotLockTheHolderOut) {
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  const MissionCommand foreign{1u << 30, orders.now_s, MissionOrder::kHold, "bob", "guess"};
  EXPECT_EQ(apply(foreign, orders.mission, orders.now_s, kRules), MissionResult::kRefusedForeign);
  EXPECT_EQ(orders.give(MissionOrder::kHold, "ada"), MissionResult::kAccepted);
}

TEST(Mission, AnOrderFromBeforeTheStopDoesNotUndoIt) {
  Orders orders;
  const MissionCommand before{1, orders.now_s, MissionOrder::kStart, "ada", ""};
  const MissionCommand stop{2, orders.now_s, MissionOrder::kStop, "ada", ""};
  apply(stop, orders.mission, orders.now_s, kRules);
  EXPECT_EQ(apply(before, orders.mission, orders.now_s, kRules), MissionResult::kRefusedRepeated);
  EXPECT_EQ(orders.mission.phase, MissionPhase::kStopped);
}

}  // namespace
}  // namespace foretrack
