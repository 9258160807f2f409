// SPDX-License-Identifier: Apache-2.0
#include "core/safety/take_order.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// An operator without a lease, a vehicle that hovers, a memory that is written when it is said so.
struct Desk {
  OrderState order;
  Mission mission;
  CarryOut carrying;
  GateMemory memory;
  MemoryWriting writing{.written_revision = 0};
  double now_s = 10.0;
  std::uint64_t last_id = 0;

  void give(MissionOrder what, const char* lease = "") {
    MissionCommand command{.id = ++last_id, .stamp_s = now_s, .order = what, .proved = true};
    command.operator_name = ShortText("ann");
    command.lease_id = ShortText(lease);
    take_order(order, mission, carrying, command, {now_s, now_s}, {}, {});
    await_writing(order, memory, remember(memory, mission));
  }
  void written() { writing.written_revision = memory.revision; }
  void failed() { writing.failed_revision = memory.revision; }
  MissionResult settled() {
    settle_orders(order, mission, carrying, writing);
    answer_order(order);
    return order.result;
  }
};

TEST(TakeOrder, ActsAtOnceAndIsConfirmedWhenItIsWritten) {
  Desk desk;
  desk.give(MissionOrder::kStart);
  EXPECT_EQ(desk.mission.phase, MissionPhase::kStarting);
  EXPECT_EQ(desk.carrying.since_s, 10.0) << "the phase has begun";
  EXPECT_EQ(desk.settled(), MissionResult::kPending);
  desk.written();
  EXPECT_EQ(desk.settled(), MissionResult::kAccepted);
  EXPECT_EQ(desk.mission.phase, MissionPhase::kStarting);
}

TEST(TakeOrder, AStartThatCannotBeWrittenIsUndone) {
  Desk desk;
  desk.give(MissionOrder::kStart);
  desk.failed();
  EXPECT_EQ(desk.settled(), MissionResult::kRefusedUnwritten);
  EXPECT_FALSE(is_active(desk.mission.phase));
  EXPECT_EQ(desk.carrying.end, MissionEnd::kUnwritten);
}

TEST(TakeOrder, AStopStandsWhetherItCanBeWrittenOrNot) {
  Desk desk;
  desk.give(MissionOrder::kStop);
  desk.failed();
  EXPECT_EQ(desk.settled(), MissionResult::kAcceptedUnwritten);
  EXPECT_EQ(desk.mission.phase, MissionPhase::kStopped);
}

TEST(TakeOrder, ALeaseThatCannotBeWrittenIsNobodys) {
  Desk desk;
  desk.give(MissionOrder::kLease, "mine");
  ASSERT_TRUE(desk.mission.lease.is_held(desk.now_s));
  desk.failed();
  EXPECT_EQ(desk.settled(), MissionResult::kRefusedUnwritten);
  EXPECT_FALSE(desk.mission.lease.is_held(desk.now_s));
}

TEST(TakeOrder, ARefusedOneChangesNothingAndWaitsForNothing) {
  Desk desk;
  desk.give(MissionOrder::kResume);
  EXPECT_EQ(desk.settled(), MissionResult::kRefusedPhase);
  EXPECT_EQ(desk.mission.phase, MissionPhase::kIdle);
  EXPECT_EQ(desk.carrying.since_s, 0.0);
}

TEST(TakeOrder, ALeaseBeginsNoPhase) {
  Desk desk;
  desk.give(MissionOrder::kLease, "mine");
  EXPECT_EQ(desk.carrying.since_s, 0.0);
}

}  // namespace
}  // namespace foretrack
