// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/coordinate.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

const Vec3 kPerson(0, 0, 1);

TargetState seen_at(const Vec3& place, double now_s) {
  TargetState t;
  t.stamp_s = t.last_measurement_s = now_s;
  t.status = TrackStatus::kTracking;
  t.position_enu_m = place;
  t.covariance = 0.01 * Mat6::Identity();
  return t;
}

TargetState lost(double now_s) {
  TargetState t = seen_at({9, 9, 1}, now_s);
  t.status = TrackStatus::kLost;
  return t;
}

// Vehicles round one person in the open, and what they know.
struct Fleet {
  explicit Fleet(int count) : states(count), inputs(count) {
    for (int i = 0; i < count; ++i) {
      inputs[i].vehicle = "uav" + std::to_string(i + 1);
      inputs[i].frame = "map";
      inputs[i].state.position_enu_m = Vec3(-2.0 - 1.2 * i, 0.7 * i, 1.5);
    }
  }
  FleetResult step(int i, double now_s) {
    inputs[i].now_s = now_s;
    if (inputs[i].target.status != TrackStatus::kLost) inputs[i].target = seen_at(kPerson, now_s);
    return coordinate(states[i], inputs[i], params);
  }
  void tell(int from, int to, const FleetMember& message, double now_s) {
    if (from != to) hear(states[to], message, now_s, params);
  }

  std::vector<FleetState> states;
  std::vector<FleetInput> inputs;
  FleetParams params;
};

bool same(const FleetDivision& a, const FleetDivision& b) {
  if (a.count != b.count) return false;
  for (int i = 0; i < a.count; ++i)
    if (!(a.parts[i].vehicle == b.parts[i].vehicle) || a.parts[i].ring != b.parts[i].ring ||
        !(a.parts[i].seat == b.parts[i].seat))
      return false;
  return true;
}

TEST(Coordinate, AloneThereIsNothingToDivide) {
  Fleet fleet(1);
  const FleetResult r = fleet.step(0, 1.0);
  EXPECT_TRUE(r.place.is_alone);
  EXPECT_EQ(r.peers.count, 0);
  EXPECT_TRUE(std::isinf(r.separation_m));
  EXPECT_EQ(r.message.vehicle.view(), "uav1");
  EXPECT_EQ(r.message.sequence_number, 1U);
  ASSERT_NE(r.message.followed(), nullptr);
  EXPECT_TRUE(r.message.followed()->in_sight);
}

// Losses, delays, reordering and partitions: within five messages of each after the last loss, all
// compute the same division.
TEST(Coordinate, AllComputeTheSameDivisionSoonAfterTheLastLoss) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const int count = random.integer(2, 5);
    Fleet fleet(count);
    for (FleetInput& in : fleet.inputs)
      in.state.position_enu_m.head<2>() =
          random.uniform(1.6, 5.0) * direction_of(random.uniform(-kPi, kPi));
    struct OnTheWay {
      double at_s;
      int to;
      FleetMember message;
    };
    std::vector<OnTheWay> link;
    std::vector<FleetResult> results(count);
    const int lossy = 40, rounds = lossy + 5;
    for (int k = 0; k < rounds; ++k) {
      const double now_s = 1.0 + 0.1 * k;
      const int split = k % 20 < 8 ? random.integer(1, count - 1) : count;  // a partition
      for (int i = 0; i < count; ++i) {
        std::erase_if(link, [&](const OnTheWay& m) {
          if (m.to != i || m.at_s > now_s) return false;
          hear(fleet.states[i], m.message, now_s, fleet.params);
          return true;
        });
        results[i] = fleet.step(i, now_s);
        for (int to = 0; to < count; ++to) {
          const bool passes = k >= lossy || (random.chance(0.7) && (i < split) == (to < split));
          const double delay_s = k >= lossy ? 0.0 : random.uniform(0.0, 0.3);
          if (to != i && passes) link.push_back({now_s + delay_s, to, results[i].message});
        }
      }
      if (k >= lossy)  // what was late comes before what is new counts
        std::stable_sort(link.begin(), link.end(),
                         [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
    }
    for (int i = 1; i < count; ++i)
      EXPECT_TRUE(same(results[0].division, results[i].division)) << "seed " << seed;
    EXPECT_EQ(results[0].division.count, count);
  }
}

TEST(Coordinate, WhoSeesNothingGoesByWhatTheOthersSee) {
  Fleet fleet(3);
  fleet.inputs[0].target = lost(1.0);
  for (int i = 1; i < 3; ++i) fleet.tell(i, 0, fleet.step(i, 1.0).message, 1.0);
  const FleetResult r = fleet.step(0, 1.1);
  EXPECT_EQ(r.target.status, TrackStatus::kTracking);
  EXPECT_LT((r.target.position_enu_m - kPerson).norm(), 0.05);
  EXPECT_EQ(r.division.count, 3);
}

TEST(Coordinate, WhoSeesThemGoesByItsOwnEyes) {
  Fleet fleet(2);
  FleetMember wrong = fleet.step(1, 1.0).message;
  wrong.persons[0].position_enu_m.x() += 0.6;
  fleet.tell(1, 0, wrong, 1.0);
  EXPECT_TRUE(fleet.step(0, 1.0).target.position_enu_m.isApprox(kPerson));
}

TEST(Coordinate, ALiarIsFoundOutAndBelievedAgainWhenItIsNone) {
  Fleet fleet(2);
  for (int k = 0; k <= 30; ++k) {
    const double now_s = 1.0 + 0.1 * k;
    FleetMember message = fleet.step(1, now_s).message;
    if (k < 25) message.persons[0].position_enu_m.x() += 2.0;
    fleet.tell(1, 0, message, now_s);
    const FleetResult r = fleet.step(0, now_s);
    const FleetTrust trust = fleet.states[0].peers[0].trust;
    if (k < 5) {
      EXPECT_EQ(trust, FleetTrust::kCommon) << "one word is no lie";
    }
    if (k > 12 && k < 25) {
      EXPECT_EQ(trust, FleetTrust::kLiar);
      EXPECT_EQ(r.division.count, 1);
      EXPECT_EQ(r.peers.count, 1) << "kept clear of all the same";
    }
    if (k >= 26) {
      EXPECT_EQ(trust, FleetTrust::kCommon);
    }
  }
}

TEST(Coordinate, ALiarIsNotFollowedBlindly) {
  Fleet fleet(2);
  double now_s = 1.0;
  for (int k = 0; k < 20; ++k, now_s += 0.1) {
    FleetMember message = fleet.step(1, now_s).message;
    message.persons[0].position_enu_m.x() += 2.0;
    fleet.tell(1, 0, message, now_s);
    fleet.step(0, now_s);
  }
  ASSERT_EQ(fleet.states[0].peers[0].trust, FleetTrust::kLiar);
  fleet.inputs[0].target = lost(now_s);
  const FleetResult r = fleet.step(0, now_s);
  EXPECT_EQ(r.target.status, TrackStatus::kLost);
}

TEST(Coordinate, AnUnalignedFrameIsNotBelieved) {
  Fleet fleet(2);
  fleet.inputs[1].frame = "uav2/odom";
  fleet.inputs[0].target = lost(1.0);
  fleet.tell(1, 0, fleet.step(1, 1.0).message, 1.0);
  const FleetResult r = fleet.step(0, 1.0);
  EXPECT_EQ(fleet.states[0].peers[0].trust, FleetTrust::kUnaligned);
  EXPECT_EQ(r.target.status, TrackStatus::kLost);
  EXPECT_EQ(r.division.count, 1);
}

TEST(Coordinate, AFrameIsAlignedByThePersonWhomBothSee) {
  Fleet fleet(2);
  fleet.inputs[1].frame = "uav2/odom";
  const Eigen::AngleAxisd turn(-0.7, Vec3::UnitZ());
  const Vec3 shift(3, 4, 0);
  const auto theirs = [&](const Vec3& ours) { return Vec3(turn * (ours - shift)); };
  FleetResult r;
  for (int k = 0; k < 200; ++k) {
    const double now_s = 1.0 + 0.1 * k;
    const Vec3 person(4.0 * std::sin(0.1 * k / 2.0), 0.12 * k, 1.0);
    for (int i = 0; i < 2; ++i) {
      fleet.inputs[i].now_s = now_s;
      const Vec3 vehicle = person + Vec3(-2.0, 2.5 * i, 0.5);
      fleet.inputs[i].target = seen_at(i == 0 ? person : theirs(person), now_s);
      fleet.inputs[i].state.position_enu_m = i == 0 ? vehicle : theirs(vehicle);
    }
    fleet.tell(1, 0, coordinate(fleet.states[1], fleet.inputs[1], fleet.params).message, now_s);
    r = coordinate(fleet.states[0], fleet.inputs[0], fleet.params);
  }
  EXPECT_EQ(fleet.states[0].peers[0].trust, FleetTrust::kAligned);
  EXPECT_EQ(r.division.count, 2);
  EXPECT_NEAR(r.separation_m, 2.5 - 0.5, 0.2);
}

TEST(Coordinate, WhoIsSilentGetsNoSeatAndIsKeptClearOf) {
  Fleet fleet(3);
  for (int i = 1; i < 3; ++i) fleet.tell(i, 0, fleet.step(i, 1.0).message, 1.0);
  EXPECT_EQ(fleet.step(0, 1.1).division.count, 3);
  fleet.tell(1, 0, fleet.step(1, 2.4).message, 2.4);
  const FleetResult r = fleet.step(0, 2.5);
  EXPECT_EQ(r.division.count, 2);
  EXPECT_EQ(r.peers.count, 3) << "the silent one may have stopped, or follow on";
  EXPECT_EQ(fleet.step(0, 30.0).peers.count, 0) << "gone";
}

// All step ten times a second; who is in one part (a number each) hears each other.
std::vector<FleetResult> fly_apart(Fleet& fleet, const std::vector<int>& parts, double from_s,
                                   double for_s) {
  const int count = static_cast<int>(parts.size());
  std::vector<FleetResult> results(parts.size());
  for (double now_s = from_s; now_s < from_s + for_s; now_s += 0.1)
    for (int i = 0; i < count; ++i) {
      results[i] = fleet.step(i, now_s);
      for (int to = 0; to < count; ++to)
        if (parts[i] == parts[to]) fleet.tell(i, to, results[i].message, now_s);
    }
  return results;
}

TEST(Coordinate, PartsThatDoNotHearEachOtherFlyOnLayersOfTheirOwn) {
  constexpr int kCount = 4;
  for (int split = 1; split < (1 << kCount) - 1; ++split) {
    Fleet fleet(kCount);
    fly_apart(fleet, {0, 0, 0, 0}, 1.0, 2.0);
    std::vector<int> parts;
    for (int i = 0; i < kCount; ++i) parts.push_back(split >> i & 1);
    const auto apart = fly_apart(fleet, parts, 3.0, 2.0);
    for (int a = 0; a < kCount; ++a) {
      EXPECT_FALSE(apart[a].place.is_alone) << split;
      for (int b = 0; b < a; ++b)
        if (parts[a] == parts[b])
          EXPECT_EQ(apart[a].place.height_m, apart[b].place.height_m) << split;
        else
          EXPECT_GE(std::abs(apart[a].place.height_m - apart[b].place.height_m),
                    fleet.params.layer_m - 1e-9)
              << split;
    }
    for (const FleetResult& r : fly_apart(fleet, {0, 0, 0, 0}, 5.0, 1.0))
      EXPECT_EQ(r.place.height_m, 0.0) << "they hear each other again";
  }
}

TEST(Coordinate, WhoeverLosesAllTheOthersHasALayerThatNobodyElseHas) {
  Fleet fleet(3);
  fly_apart(fleet, {0, 0, 0}, 1.0, 2.0);
  const auto apart = fly_apart(fleet, {0, 1, 2}, 3.0, 2.0);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(apart[i].place.height_m, (i + 1) * fleet.params.layer_m, 1e-9);
  const double gone_s = 5.0 + fleet.params.forget_s;
  EXPECT_TRUE(fleet.step(2, gone_s).place.is_alone) << "they are forgotten";
}

TEST(Coordinate, WhereOneOfThreeDiesTheOthersStayWhereTheyAre) {
  for (int dead = 0; dead < 3; ++dead) {
    Fleet fleet(3);
    fly_apart(fleet, {0, 0, 0}, 1.0, 2.0);
    std::vector<int> parts = {0, 0, 0};
    parts[dead] = 1;
    const auto left = fly_apart(fleet, parts, 3.0, 2.0);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(left[i].place.height_m > 0.0, i == dead) << dead;
  }
}

TEST(Coordinate, TheSeatIsKeptWhileAllComeToTheirLayers) {
  Fleet fleet(3);
  fly_apart(fleet, {0, 0, 0}, 1.0, 2.0);
  const auto parted = fly_apart(fleet, {0, 1, 1}, 3.0, 1.5);
  fleet.inputs[1].state.position_enu_m = {4.0, -4.0, 1.5};  // from there, another one is better
  const auto kept = fly_apart(fleet, {0, 1, 1}, 4.5, 1.0);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(kept[i].place.seat.sector(), parted[i].place.seat.sector()) << i;
  const auto there = fly_apart(fleet, {0, 1, 1}, 5.5, 4.0);
  EXPECT_NE(there[1].place.seat.sector(), parted[1].place.seat.sector());
}

TEST(Coordinate, ThePlanThatIsToldIsWhatIsLeftOfIt) {
  Fleet fleet(1);
  PlannedTrajectory plan;
  plan.start_s = 1.0;
  for (int i = 0; i < 30; ++i) {
    QuinticPiece piece;
    piece.duration_s = 0.5;
    piece.coefficients.row(0) = Vec3(0.5 * i, 0, 1).transpose();
    piece.coefficients.row(1) = Vec3(1, 0, 0).transpose();
    plan.pieces.push_back(piece);
  }
  fleet.inputs[0].plan = &plan;
  const FleetMember m = fleet.step(0, 3.2).message;
  ASSERT_FALSE(m.plan.empty());
  EXPECT_LE(m.plan.count, FleetPlan::kMaxPieces);
  for (const double t : {3.2, 4.0, 6.9}) EXPECT_NEAR(m.plan.position(t).x(), t - 1.0, 1e-9);
}

}  // namespace
}  // namespace foretrack
