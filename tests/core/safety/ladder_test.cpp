// SPDX-License-Identifier: Apache-2.0
#include "core/safety/ladder.hpp"

#include <gtest/gtest.h>

#include "tests/core/safety/flight_loop.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack::testing {
namespace {

using Mode = SafetyMode;
using Reason = SafetyReason;

LadderInput all_is_well() {
  LadderInput in;
  in.phase = MissionPhase::kTracking;
  in.engaged = in.has_plan = in.plan_fresh = true;
  return in;
}

struct Step {
  const char* name;
  void (*happens)(LadderInput&);
  Mode mode;
  Reason reason;
};

// From the worst to the best: each holds whatever of the later ones does.
const Step kSteps[] = {
    {"no vehicle", [](auto& in) { in.vehicle_lost = true; }, Mode::kSilent, Reason::kVehicleStale},
    {"no autopilot", [](auto& in) { in.autopilot_lost = true; }, Mode::kSilent,
     Reason::kAutopilotStale},
    {"no planner", [](auto& in) { in.planner_lost = true; }, Mode::kSilent, Reason::kPlanStale},
    {"stale vehicle", [](auto& in) { in.vehicle_stale = true; }, Mode::kBrake,
     Reason::kVehicleStale},
    {"jumps", [](auto& in) { in.odometry = OdometryFault::kJumps; }, Mode::kBrake,
     Reason::kOdometryJumps},
    {"no plan", [](auto& in) { in.has_plan = false; }, Mode::kHover, Reason::kNoPlanYet},
    {"off", [](auto& in) { in.off_trajectory = true; }, Mode::kBrake, Reason::kOffTrajectory},
    {"obstacle", [](auto& in) { in.flown = PlanFault::kObstacle; }, Mode::kBrake,
     Reason::kPlanBlocked},
    {"limit",
     [](auto& in) {
       in.limit = {Reaction::kHold, LimitKind::kLink};
     },
     Mode::kHover, Reason::kLink},
    {"images", [](auto& in) { in.images_blind = true; }, Mode::kHover, Reason::kImages},
    {"ended", [](auto& in) { in.plan_ended = true; }, Mode::kHover, Reason::kPlanHolds},
    {"stale plan", [](auto& in) { in.plan_fresh = false; }, Mode::kCoast, Reason::kPlanStale},
};

TEST(Ladder, TheWorstThatHoldsDecides) {
  LadderInput in = all_is_well();
  EXPECT_EQ(choose_rung(in).mode, Mode::kTrack);
  for (auto step = std::rbegin(kSteps); step != std::rend(kSteps); ++step) {
    LadderInput alone = all_is_well();
    step->happens(alone);
    EXPECT_EQ(choose_rung(alone).mode, step->mode) << step->name;
    EXPECT_EQ(choose_rung(alone).reason, step->reason) << step->name;
    step->happens(in);
    if (step->reason == Reason::kPlanHolds) continue;  // it is said as ended while it is stale
    EXPECT_EQ(choose_rung(in).mode, step->mode) << step->name << " with all after it";
    EXPECT_EQ(choose_rung(in).reason, step->reason) << step->name << " with all after it";
  }
}

TEST(Ladder, NamesEachFault) {
  LadderInput in = all_is_well();
  in.odometry = OdometryFault::kFrozen;
  EXPECT_EQ(choose_rung(in).reason, Reason::kOdometryFrozen);
  in.odometry = OdometryFault::kDisagrees;
  EXPECT_EQ(choose_rung(in).reason, Reason::kOdometryDisagrees);
  in = all_is_well();
  in.flown = PlanFault::kBody;
  EXPECT_EQ(choose_rung(in).reason, Reason::kBodyNear);
  in.flown = PlanFault::kBounds;
  EXPECT_EQ(choose_rung(in).reason, Reason::kFence);
  in = all_is_well();
  in.plan_ended = true;
  in.plan_fresh = false;
  EXPECT_EQ(choose_rung(in).reason, Reason::kPlanEnded);
  for (int i = 1; i < 20; ++i) EXPECT_FALSE(to_string(static_cast<Reason>(i)).empty());
  EXPECT_EQ(to_string(Mode::kSilent), "silent");
}

TEST(Ladder, IsSilentInAPhaseThatIsNotOursAndHoldsInOneThatIs) {
  for (const auto phase :
       {MissionPhase::kIdle, MissionPhase::kHolding, MissionPhase::kStopped,
        MissionPhase::kReturning, MissionPhase::kLanding, MissionPhase::kTakingOff}) {
    LadderInput in = all_is_well();
    in.phase = phase;
    EXPECT_EQ(choose_rung(in).mode, Mode::kHover);
    EXPECT_EQ(choose_rung(in).reason, Reason::kMission);
    in.planner_lost = true;
    EXPECT_EQ(choose_rung(in).mode, Mode::kHover) << "a hold needs no planner";
    in.engaged = false;
    EXPECT_EQ(choose_rung(in).mode, Mode::kSilent);
  }
}

TEST(Ladder, DoesNotFlickerWhenTheVehiclesStatesComeLateNowAndThen) {
  FlightLoop loop;
  loop.take_off_and_track();
  int changes = 0;
  SafetyMode before = loop.result.mode;
  for (int i = 0; i < 3000; ++i) {
    loop.vehicle_alive = i % 33 == 32;  // a third of a second apart: later than allowed
    loop.run_with_plans(kTick_s);
    changes += loop.result.mode != before;
    before = loop.result.mode;
  }
  EXPECT_LE(changes, 1);
  EXPECT_EQ(loop.result.mode, Mode::kBrake);
  EXPECT_TRUE(loop.result.heartbeat);
}

TEST(Ladder, BlindImagesHoldUntilTheySeeAgain) {
  FlightLoop loop;
  loop.take_off_and_track();
  loop.extra.images_blind = true;
  EXPECT_EQ(loop.run_with_plans(1.0).reason, Reason::kImages);
  loop.extra.images_blind = false;
  EXPECT_EQ(loop.run_with_plans(1.0).mode, Mode::kTrack);
  loop.params.heeds_images = false;
  loop.extra.images_blind = true;
  EXPECT_EQ(loop.run_with_plans(1.0).mode, Mode::kTrack);
}

TEST(Ladder, TheWholeLoopAllocatesNothing) {
  FlightLoop loop;
  loop.take_off_and_track();
  const GridMap& map = open_map();
  MovingBodies bodies;
  bodies.add({.position_enu_m = Vec3(5, 5, 0)});
  loop.extra.map = &map;
  loop.extra.bodies = &bodies;
  PlannedTrajectory plan = straight_plan(++loop.last_plan, 0.0);
  MissionCommand hold{.order = MissionOrder::kHold, .operator_name = "somebody with a long name"};
  const long before = allocation_count();
  for (int i = 0; i < 2000; ++i) {
    plan.id = ++loop.last_plan;
    plan.stamp_s = plan.start_s = loop.stamp_now_s() + 0.02;
    for (auto& piece : plan.pieces) piece.coefficients.row(0) += 0.001 * Vec3::UnitX().transpose();
    hold.id = ++loop.last_order;
    hold.stamp_s = loop.stamp_now_s();
    hold.order = i % 2 ? MissionOrder::kHold : MissionOrder::kResume;
    loop.extra.bodies_at_s = loop.now_s;
    loop.tick(i % 3 == 0 ? &plan : nullptr, i % 50 == 0 ? &hold : nullptr);
  }
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace foretrack::testing
