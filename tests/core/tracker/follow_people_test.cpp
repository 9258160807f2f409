// SPDX-License-Identifier: Apache-2.0
#include "core/tracker/follow_people.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr double kLook_s = 0.03;
constexpr double kHeight_m = 1.75;

/// Ada is observed, as a position; Bob is sighted by a detector. Both walk along x.
struct Walkers {
  PerceptionParams perception;
  BodyParams body;
  ChoiceParams choice;
  PerceptionState target;
  BodiesState bodies;
  ChoiceState chosen;
  VehicleHistory vehicle;
  MovingBodies around;
  std::array<PersonLook, MovingBodies::kCapacity> looks;
  double now_s = 10.0;
  bool ada_is_observed = true;
  ChoiceResult last;

  PeopleTracks people() { return {target, bodies, chosen}; }
  PeopleParams params() const { return {perception, body, choice}; }
  Vec2 ada_m() const { return {now_s - 10.0, 0.0}; }
  Vec2 bob_m() const { return {0.8 * (now_s - 10.0) + 1.0, 4.0}; }
  TargetState state() const { return coast(target, now_s, perception); }

  void frame(std::optional<std::uint32_t> order = {}) {
    now_s += kLook_s;
    TargetObservation ada;
    ada.kind = TargetObservation::Kind::kPosition;
    ada.stamp_s = now_s;
    ada.position_enu_m << ada_m(), kTorsoShare * kHeight_m;
    ada.covariance_m2 = 1e-3 * Mat3::Identity();
    if (ada_is_observed && !take_as_other(people(), ada, vehicle, params()))
      perceive(target, ada, vehicle, perception);
    BodySightings seen;
    seen.stamp_s = now_s;
    BodySighting bob{BodyKind::kPerson, Vec3(bob_m().x(), bob_m().y(), 0.0),
                     1e-3 * Mat2::Identity()};
    seen.add(bob);
    take_sightings(people(), seen, {}, vehicle, params());
    const TargetState followed = state();
    bodies_around(bodies, now_s, {followed, nullptr, kHeight_m}, Vec3::Zero(), body, around, looks);
    last = choose_person(
        people(),
        {.now_s = now_s, .bodies = around, .looks = looks, .vehicle_enu_m = {}, .order = order},
        params());
  }
  void run(double for_s) {
    for (const double end_s = now_s + for_s; now_s < end_s;) frame();
  }
  const MovingBody* body_of(std::uint32_t id) const {
    for (const MovingBody& b : around.all())
      if (b.id == id) return &b;
    return nullptr;
  }
};

TEST(FollowPeople, WithoutAnOrderObservationsAreOfWhoIsFollowed) {
  Walkers walkers;
  walkers.run(2.0);
  EXPECT_LT((walkers.state().position_enu_m.head<2>() - walkers.ada_m()).norm(), 0.1);
  EXPECT_EQ(walkers.around.count, 2);
  EXPECT_EQ(walkers.last.status, ChoiceStatus::kFollowing);
}

TEST(FollowPeople, AnotherPersonIsFollowedOnOrderAndTheFirstOneIsStillThere) {
  Walkers walkers;
  walkers.run(2.0);
  const std::uint32_t ada = walkers.around.bodies[0].id, bob = walkers.around.bodies[1].id;
  walkers.frame(bob);
  walkers.frame();
  EXPECT_LT((walkers.state().position_enu_m.head<2>() - walkers.bob_m()).norm(), 0.1)
      << "it begins anew at him, at once";
  EXPECT_NEAR(walkers.state().velocity_enu_m_s.x(), 0.8, 0.2);
  walkers.run(4.0);
  EXPECT_EQ(walkers.state().status, TrackStatus::kTracking) << "sightings of him are enough";
  EXPECT_LT((walkers.state().position_enu_m.head<2>() - walkers.bob_m()).norm(), 0.1);
  EXPECT_EQ(walkers.around.bodies[0].id, bob);
  ASSERT_NE(walkers.body_of(ada), nullptr) << "observations of her are sightings now";
  EXPECT_LT((walkers.body_of(ada)->position_enu_m.head<2>() - walkers.ada_m()).norm(), 0.2);
  EXPECT_EQ(walkers.around.count, 2);
}

TEST(FollowPeople, NobodyIsFollowedOnOrderAndThenSomebodyAgain) {
  Walkers walkers;
  walkers.run(2.0);
  const std::uint32_t ada = walkers.around.bodies[0].id;
  walkers.frame(0);
  walkers.run(2.0);
  EXPECT_EQ(walkers.state().status, TrackStatus::kNone);
  EXPECT_EQ(walkers.last.status, ChoiceStatus::kWaiting);
  ASSERT_NE(walkers.body_of(ada), nullptr);
  EXPECT_FALSE(walkers.body_of(ada)->followed);
  walkers.frame(ada);
  walkers.run(1.0);
  EXPECT_EQ(walkers.state().status, TrackStatus::kTracking);
  EXPECT_LT((walkers.state().position_enu_m.head<2>() - walkers.ada_m()).norm(), 0.1);
  EXPECT_EQ(walkers.last.person_id, ada);
}

TEST(FollowPeople, WhoIsFollowedByObservationsAloneIsFollowedOnThroughThem) {
  Walkers walkers;
  walkers.run(2.0);
  walkers.frame(walkers.around.bodies[0].id);  // whom it follows anyway
  walkers.run(2.0);
  EXPECT_LT((walkers.state().position_enu_m.head<2>() - walkers.ada_m()).norm(), 0.1);
  walkers.ada_is_observed = false;
  walkers.run(3.0);
  EXPECT_EQ(walkers.state().status, TrackStatus::kLost);
  EXPECT_EQ(walkers.last.status, ChoiceStatus::kSearching);
}

}  // namespace
}  // namespace foretrack
