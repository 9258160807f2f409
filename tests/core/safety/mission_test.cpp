// SPDX-License-Identifier: Apache-2.0
#include "core/safety/mission.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace foretrack {
namespace {

constexpr MissionRules kRules{.max_age_s = 1.0, .future_s = 0.5, .lease_s = 5.0};
constexpr std::uint64_t kHighest = std::numeric_limits<std::uint64_t>::max();
constexpr auto kAll = {
    MissionOrder::kStart,   MissionOrder::kHold,       MissionOrder::kResume,
    MissionOrder::kReturn,  MissionOrder::kLand,       MissionOrder::kLease,
    MissionOrder::kRelease, MissionOrder::kTakeOff,    MissionOrder::kSetBounds,
    MissionOrder::kFollow,  MissionOrder::kSetFraming, MissionOrder::kSetReturnPlace};

/// A mission that tracks, and orders a moment apart.
struct Orders {
  Mission mission{.phase = MissionPhase::kTracking, .engaged = true};
  double now_s = 100.0;
  std::uint64_t id = 0;
  bool proved = true;

  MissionCommand order(MissionOrder what, const char* name = "ada") {
    return {.id = ++id,
            .stamp_s = now_s,
            .order = what,
            .operator_name = name,
            .lease_id = name,
            .proved = proved};
  }
  MissionResult give(const MissionCommand& command) {
    return apply(command, mission, {now_s, now_s}, kRules);
  }
  MissionResult give(MissionOrder what, const char* name = "ada") {
    now_s += 0.01;
    return give(order(what, name));
  }
};

TEST(Mission, AnybodyMayOrderWhileNobodyHoldsTheLease) {
  Orders orders;
  orders.proved = false;
  EXPECT_EQ(orders.give(MissionOrder::kHold, "ada"), MissionResult::kAccepted);
  EXPECT_EQ(orders.give(MissionOrder::kResume, "bob"), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
}

TEST(Mission, RefusesEveryOrderOfOthersButStopWhileTheLeaseIsHeld) {
  for (const auto order : kAll) {
    Orders orders;
    ASSERT_EQ(orders.give(MissionOrder::kLease, "ada"), MissionResult::kAccepted);
    EXPECT_EQ(orders.give(order, "bob"), MissionResult::kRefusedForeign) << to_string(order);
    EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
    EXPECT_EQ(orders.mission.lease.operator_name.view(), "ada");
  }
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  orders.proved = false;
  EXPECT_EQ(orders.give(MissionOrder::kStop, "bob"), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.phase, MissionPhase::kStopped);
}

TEST(Mission, RefusesWhatNamesTheLeaseWithoutProof) {
  for (const auto order : kAll) {
    Orders orders;
    ASSERT_EQ(orders.give(MissionOrder::kLease), MissionResult::kAccepted);
    orders.proved = false;
    EXPECT_EQ(orders.give(order), MissionResult::kRefusedUnproved) << to_string(order);
    EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
  }
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
  EXPECT_EQ(orders.mission.lease.operator_name.view(), "bob");
}

TEST(Mission, AReleasedVehicleCanBeTakenAtOnce) {
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  EXPECT_EQ(orders.give(MissionOrder::kRelease, "ada"), MissionResult::kAccepted);
  EXPECT_FALSE(orders.mission.lease.is_held(orders.now_s));
  EXPECT_EQ(orders.give(MissionOrder::kLease, "bob"), MissionResult::kAccepted);
}

TEST(Mission, ALeaseWithoutANameIsRefused) {
  Mission mission;
  const MissionCommand command{.id = 1, .order = MissionOrder::kLease, .proved = true};
  EXPECT_EQ(apply(command, mission, {0.0, 0.0}, kRules), MissionResult::kRefusedUnproved);
}

TEST(Mission, AStrangersHighIdDoesNotLockTheHolderOut) {
  Orders orders;
  orders.give(MissionOrder::kLease, "ada");
  MissionCommand foreign = orders.order(MissionOrder::kHold, "bob");
  foreign.id = kHighest;
  EXPECT_EQ(orders.give(foreign), MissionResult::kRefusedForeign);
  EXPECT_EQ(orders.give(MissionOrder::kHold, "ada"), MissionResult::kAccepted);
}

TEST(Mission, TheHighestIdLocksNobodyOut) {
  for (const auto first : {MissionOrder::kHold, MissionOrder::kStop, MissionOrder::kLand}) {
    Orders orders;
    MissionCommand highest = orders.order(first);
    highest.id = kHighest;
    ASSERT_EQ(orders.give(highest), MissionResult::kAccepted);
    EXPECT_EQ(orders.give(MissionOrder::kReturn) == MissionResult::kAccepted,
              first != MissionOrder::kLand);
    EXPECT_EQ(orders.give(MissionOrder::kLand), MissionResult::kAccepted);
    EXPECT_EQ(orders.give(MissionOrder::kStop), MissionResult::kAccepted);
  }
}

TEST(Mission, AStampFromTheFutureLocksNobodyOut) {
  Orders orders;
  MissionCommand future = orders.order(MissionOrder::kHold);
  future.stamp_s = orders.now_s + 3600.0;
  EXPECT_EQ(orders.give(future), MissionResult::kRefusedFuture);
  future.stamp_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(orders.give(future), MissionResult::kRefusedFuture);
  future.order = MissionOrder::kStop;
  for (const double stamp_s : {orders.now_s + 3600.0, std::nan("")}) {
    future.stamp_s = stamp_s;
    EXPECT_EQ(orders.give(future), MissionResult::kAccepted);
  }
  EXPECT_EQ(orders.give(MissionOrder::kReturn), MissionResult::kAccepted);
}

TEST(Mission, RefusesWhatIsLateOrWasHeardBefore) {
  Orders orders;
  const MissionCommand hold = orders.order(MissionOrder::kHold);
  EXPECT_EQ(orders.give(hold), MissionResult::kAccepted);
  EXPECT_EQ(orders.give(hold), MissionResult::kRefusedRepeated);
  MissionCommand late = orders.order(MissionOrder::kResume);
  late.stamp_s -= 1.1;
  EXPECT_EQ(orders.give(late), MissionResult::kRefusedLate);
  MissionCommand overtaken = orders.order(MissionOrder::kResume);
  overtaken.stamp_s -= 0.5;
  EXPECT_EQ(orders.give(overtaken), MissionResult::kRefusedRepeated);
}

TEST(Mission, LandIsTakenHoweverOldOrRepeatedAndInEveryPhase) {
  for (const auto phase : {MissionPhase::kIdle, MissionPhase::kTracking, MissionPhase::kHolding,
                           MissionPhase::kReturning, MissionPhase::kLanding, MissionPhase::kStopped,
                           MissionPhase::kStarting, MissionPhase::kTakingOff}) {
    Orders orders;
    orders.mission.phase = phase;
    MissionCommand land = orders.order(MissionOrder::kLand);
    land.stamp_s -= 1000.0;
    EXPECT_EQ(orders.give(land), MissionResult::kAccepted);
    EXPECT_EQ(orders.give(land), MissionResult::kAccepted);
    EXPECT_EQ(orders.mission.phase, MissionPhase::kLanding);
  }
}

TEST(Mission, AnOrderFromBeforeTheStopDoesNotUndoIt) {
  for (const double ahead_s : {0.0, -0.3}) {  // of the clock of who stops
    Orders orders;
    MissionCommand stop = orders.order(MissionOrder::kStop);
    const MissionCommand before = orders.order(MissionOrder::kStart);
    orders.now_s += 0.05;
    stop.stamp_s += ahead_s;
    orders.give(stop);
    EXPECT_EQ(orders.give(before), MissionResult::kRefusedRepeated);
    EXPECT_EQ(orders.mission.phase, MissionPhase::kStopped);
  }
}

TEST(Mission, AClockThatIsSetLocksNobodyOut) {
  Orders orders;
  EXPECT_EQ(orders.give(MissionOrder::kHold), MissionResult::kAccepted);
  for (const double step_s : {-3600.0, 7200.0}) {
    orders.now_s += step_s;
    EXPECT_EQ(orders.give(MissionOrder::kResume), MissionResult::kAccepted) << step_s;
    EXPECT_EQ(orders.give(MissionOrder::kHold), MissionResult::kAccepted) << step_s;
  }
}

struct Move {
  MissionPhase from;
  MissionOrder order;
  bool engaged;
  std::optional<MissionPhase> to;  // none: refused
};

TEST(Mission, OrdersMoveItFromPhaseToPhase) {
  using P = MissionPhase;
  using O = MissionOrder;
  const Move moves[] = {
      {P::kIdle, O::kStart, false, P::kStarting},
      {P::kStopped, O::kStart, true, P::kTracking},
      {P::kTracking, O::kStart, true, std::nullopt},
      {P::kHolding, O::kStart, true, std::nullopt},
      {P::kTracking, O::kHold, true, P::kHolding},
      {P::kReturning, O::kHold, false, P::kHolding},
      {P::kTakingOff, O::kHold, false, P::kHolding},
      {P::kStopped, O::kHold, true, std::nullopt},
      {P::kHolding, O::kResume, true, P::kTracking},
      {P::kHolding, O::kResume, false, P::kStarting},
      {P::kStopped, O::kResume, true, std::nullopt},
      {P::kStopped, O::kReturn, true, P::kReturning},
      {P::kLanding, O::kReturn, true, std::nullopt},
      {P::kIdle, O::kTakeOff, false, P::kTakingOff},
      {P::kTracking, O::kTakeOff, true, std::nullopt},
      {P::kStarting, O::kStop, false, P::kStopped},
      {P::kTracking, O::kLease, true, P::kTracking},
      {P::kTracking, O::kRelease, true, P::kTracking},
  };
  for (const Move& move : moves) {
    Orders orders;
    orders.mission.phase = move.from;
    orders.mission.engaged = move.engaged;
    EXPECT_EQ(orders.give(move.order),
              move.to ? MissionResult::kAccepted : MissionResult::kRefusedPhase)
        << to_string(move.from) << " " << to_string(move.order);
    EXPECT_EQ(orders.mission.phase, move.to.value_or(move.from));
  }
}

struct People {
  MovingBodies bodies;
  People() {
    bodies.add({.id = 7, .kind = BodyKind::kPerson});
    bodies.add({.id = 8, .kind = BodyKind::kVehicle});
  }
};

TEST(Mission, FollowsAPersonWhoIsThereOrNobody) {
  const People people;
  Orders orders;
  orders.give(MissionOrder::kLease);
  const auto follow = [&](std::uint32_t id, const MovingBodies* bodies) {
    orders.now_s += 0.01;
    MissionCommand command = orders.order(MissionOrder::kFollow);
    command.person_id = id;
    return apply(command, orders.mission, {orders.now_s, orders.now_s}, kRules, bodies);
  };
  EXPECT_FALSE(orders.mission.person.made);
  EXPECT_EQ(follow(7, &people.bodies), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.person, (PersonChoice{true, 7}));
  EXPECT_EQ(follow(6, &people.bodies), MissionResult::kRefusedPerson) << "nobody has that number";
  EXPECT_EQ(follow(8, &people.bodies), MissionResult::kRefusedPerson) << "a vehicle";
  EXPECT_EQ(follow(7, nullptr), MissionResult::kRefusedPerson) << "nobody is known";
  EXPECT_EQ(orders.mission.person, (PersonChoice{true, 7}));
  EXPECT_EQ(follow(0, nullptr), MissionResult::kAccepted);
  EXPECT_EQ(orders.mission.person, (PersonChoice{true, 0}));
  EXPECT_EQ(orders.mission.phase, MissionPhase::kTracking);
}

TEST(Mission, TakesFramingsThatAreSafeAndKeepsTheLastOne) {
  Orders orders;
  orders.give(MissionOrder::kLease);
  const auto frame = [&](const Framing& framing) {
    orders.now_s += 0.01;
    MissionCommand command = orders.order(MissionOrder::kSetFraming);
    command.framing = framing;
    return orders.give(command);
  };
  const Framing wanted{.distance_m = 4.0, .height_m = 1.0};
  EXPECT_EQ(frame(wanted), MissionResult::kAccepted);
  EXPECT_EQ(frame({.distance_m = 0.5}), MissionResult::kRefusedFraming);
  EXPECT_EQ(orders.mission.framing, wanted);
  EXPECT_EQ(frame({}), MissionResult::kAccepted);
  EXPECT_TRUE(orders.mission.framing.is_free());
}

TEST(Mission, SettingsAreMadeUnderTheLeaseAlone) {
  for (const auto order : {MissionOrder::kSetBounds, MissionOrder::kFollow,
                           MissionOrder::kSetFraming, MissionOrder::kSetReturnPlace}) {
    Orders orders;
    EXPECT_EQ(orders.give(order), MissionResult::kRefusedUnproved) << to_string(order);
    orders.give(MissionOrder::kLease);
    EXPECT_EQ(orders.give(order), MissionResult::kAccepted) << to_string(order);
  }
}

TEST(Mission, APlaceToReturnToMustBeInTheFenceAtAnyAltitude) {
  Orders orders;
  orders.give(MissionOrder::kLease);
  const auto place = [&](double x_m, double y_m) {
    orders.now_s += 0.01;
    MissionCommand command = orders.order(MissionOrder::kSetReturnPlace);
    command.return_place_enu_m = {x_m, y_m};
    return orders.give(command);
  };
  EXPECT_EQ(place(500.0, 0.0), MissionResult::kAccepted) << "there is no fence";
  FlightBounds& bounds = orders.mission.bounds;
  bounds.corner_count = 3;
  bounds.corners_enu_m[1] = {10.0, 0.0};
  bounds.corners_enu_m[2] = {0.0, 10.0};
  bounds.altitude_min_m = 3.0;
  EXPECT_EQ(place(2.0, 2.0), MissionResult::kAccepted);
  EXPECT_EQ(place(8.0, 8.0), MissionResult::kRefusedPlace);
  for (const auto phase : {MissionPhase::kReturning, MissionPhase::kLanding}) {
    orders.mission.phase = phase;
    EXPECT_EQ(place(2.0, 2.0), MissionResult::kRefusedPhase) << "it is on its way there";
  }
}

TEST(Mission, TakesBoundsThatAreSoundAndKeepsTheLastOnes) {
  Orders orders;
  ASSERT_EQ(orders.give(MissionOrder::kLease), MissionResult::kAccepted);
  MissionCommand command = orders.order(MissionOrder::kSetBounds);
  command.bounds.altitude_max_m = 10.0;
  EXPECT_EQ(orders.give(command), MissionResult::kAccepted);
  command = orders.order(MissionOrder::kSetBounds);
  command.bounds.corner_count = 2;
  EXPECT_EQ(orders.give(command), MissionResult::kRefusedBounds);
  EXPECT_EQ(orders.mission.bounds.altitude_max_m, 10.0);
}

TEST(Mission, TakesBoundsFromTheLeasesHolderAlone) {
  Orders orders;
  EXPECT_EQ(orders.give(MissionOrder::kSetBounds), MissionResult::kRefusedUnproved)
      << "nobody holds the lease";
  ASSERT_EQ(orders.give(MissionOrder::kLease), MissionResult::kAccepted);
  EXPECT_EQ(orders.give(MissionOrder::kSetBounds, "bob"), MissionResult::kRefusedForeign);
  orders.proved = false;
  EXPECT_EQ(orders.give(MissionOrder::kSetBounds), MissionResult::kRefusedUnproved);
  orders.proved = true;
  EXPECT_EQ(orders.give(MissionOrder::kSetBounds), MissionResult::kAccepted);
}

TEST(Mission, OnlyWhatMakesItFlyOrBindsItMustOutliveARestart) {
  for (const auto order : kAll)
    EXPECT_EQ(needs_memory(order),
              order == MissionOrder::kStart || order == MissionOrder::kResume ||
                  order == MissionOrder::kTakeOff || order == MissionOrder::kLease ||
                  (is_setting(order) && order != MissionOrder::kSetReturnPlace))
        << to_string(order);
  EXPECT_FALSE(needs_memory(MissionOrder::kStop));
}

TEST(Mission, EverythingHasAName) {
  for (const auto order : kAll) EXPECT_FALSE(to_string(order).empty());
  EXPECT_EQ(to_string(MissionOrder::kSetBounds), "set_bounds");
  EXPECT_EQ(to_string(MissionOrder::kSetFraming), "set_framing");
  EXPECT_EQ(to_string(MissionResult::kRefusedFraming),
            "refused: this framing is out of its safe ranges");
  EXPECT_EQ(to_string(MissionOrder::kSetReturnPlace), "set_return_place");
  EXPECT_EQ(to_string(MissionResult::kRefusedPlace), "refused: this place is outside of the fence");
  EXPECT_EQ(to_string(MissionPhase::kTakingOff), "taking off");
  EXPECT_EQ(to_string(MissionResult::kAcceptedUnwritten),
            "accepted, but a restart would forget it");
}

}  // namespace
}  // namespace foretrack
