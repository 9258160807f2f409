// SPDX-License-Identifier: Apache-2.0
#include "core/choice/choose.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr double kFrame_s = 0.04;
constexpr std::uint32_t kAda = 1, kBob = 2, kCid = 3;

Appearance clothes(double redness) {
  Appearance a;
  a.colors[0] = redness;
  return a;
}

/// Ada is followed, 3 m before the vehicle; the others are where the test puts them.
struct Street {
  ChoiceParams params;
  ChoiceState state;
  ChoiceResult last;
  MovingBodies bodies;
  std::array<PersonLook, MovingBodies::kCapacity> looks;
  double now_s = 10.0;
  bool doubtful = false, images = true;
  std::optional<std::uint32_t> order;

  struct Person {
    std::uint32_t id;
    Vec3 place_enu_m;
    double redness;
    bool followed = false;
  };
  std::vector<Person> people{{kAda, {3, 0, 0}, 0.5, true}};

  Person& person(std::uint32_t id) { return *std::ranges::find(people, id, &Person::id); }
  const ChoiceResult& frame() {
    now_s += kFrame_s;
    bodies = {};
    std::ranges::stable_sort(people, {}, [](const Person& p) { return !p.followed; });
    for (const Person& p : people) {
      PersonLook& look = looks[bodies.count] = {};
      if (images) look.stamp_s = now_s;
      if (images) look.wears = clothes(p.redness);
      bodies.add({.id = p.id,
                  .kind = BodyKind::kPerson,
                  .followed = p.followed,
                  .stamp_s = now_s,
                  .position_enu_m = p.place_enu_m});
    }
    last = choose(state,
                  {.now_s = now_s,
                   .bodies = bodies,
                   .looks = looks,
                   .vehicle_enu_m = {0, 0, 1.5},
                   .doubtful = doubtful,
                   .order = std::exchange(order, std::nullopt)},
                  params);
    if (last.take_over) obey(*last.take_over, last.by_order);
    return last;
  }
  /// The first frame in which somebody is taken over ends it.
  const ChoiceResult& run(double for_s) {
    for (const double end_s = now_s + for_s; now_s < end_s;)
      if (frame().take_over) break;
    return last;
  }
  void obey(std::uint32_t id, bool by_order) {
    for (Person& p : people) {
      const bool was = std::exchange(p.followed, p.id == id);
      if (by_order || id == 0) continue;
      if (was) p.id = id;  // they have exchanged their numbers
      if (p.followed) p.id = state.followed_id;
    }
  }
  void lose() {
    std::erase_if(people, [](const Person& p) { return p.followed; });
  }
  /// Somebody comes up to her, walks beside, and goes away again; images leave a doubt meanwhile.
  void meet(std::uint32_t id, double redness, double doubt_for_s = 0.4) {
    people.push_back({id, {3, 0.5, 0}, redness});
    doubtful = doubt_for_s > 0.0;
    run(doubt_for_s);
    doubtful = false;
    run(0.2);
    person(id).place_enu_m = {3, 2.5, 0};
  }
};

TEST(Choose, WaitsUntilSomebodyIsSeen) {
  Street street;
  street.people.clear();
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kWaiting);
  EXPECT_EQ(street.last.person_id, 0u);
}

TEST(Choose, FollowsWithoutAQuestionWhereNobodyElseIs) {
  Street street;
  street.run(5.0);
  EXPECT_EQ(street.last.status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.last.person_id, kAda);
  EXPECT_GT(street.last.likeness, 0.99);
  ASSERT_TRUE(street.state.wears);
}

TEST(Choose, WhatIsRememberedFollowsTheLightSlowly) {
  Street street;
  street.run(2.0);
  street.person(kAda).redness = 0.7;
  street.run(1.0);
  EXPECT_NEAR(street.state.wears->colors[0], 0.5 + 0.2 / street.params.learn_s, 0.01);
  street.run(100.0);
  EXPECT_NEAR(street.state.wears->colors[0], 0.7, 0.01);
}

TEST(Choose, SomebodyElseNearIsNoDoubtWhileTheImagesLeaveNone) {
  Street street;
  street.run(2.0);
  street.people.push_back({kBob, {3, 3, 0}, 0.5});
  street.run(0.5);
  for (const double y_m : {0.5, 3.0}) {  // is seen to come, and to go
    street.person(kBob).place_enu_m.y() = y_m;
    EXPECT_EQ(street.run(3.0).status, ChoiceStatus::kFollowing);
    EXPECT_EQ(street.last.count, 0);
  }
}

TEST(Choose, WhoIsSuddenlyBesideThemAndAlikeMayBeThem) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 0.5, 0.0);  // images leave no doubt: nobody saw two
  EXPECT_EQ(street.run(3.0).status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.count, 2);
}

TEST(Choose, WhoIsSuddenlyBesideThemInOtherClothesIsNot) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 1.2, 0.0);
  EXPECT_EQ(street.run(3.0).status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.last.count, 0);
  EXPECT_TRUE(street.person(kAda).followed);
}

TEST(Choose, AfterADoubtOtherClothesTellThemApart) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 1.2);
  for (double t_s = 0.0; t_s < 3.0; t_s += kFrame_s)
    EXPECT_EQ(street.frame().status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.state.met_count, 0) << "it is over";
  EXPECT_TRUE(street.person(kAda).followed);
}

TEST(Choose, WhoWasTakenForThemIsGivenUpForThem) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 0.5);             // he turns out to be her,
  street.person(kAda).redness = 0.8;  // and who is followed somebody else
  const ChoiceResult& result = street.run(3.0);
  ASSERT_TRUE(result.take_over);
  EXPECT_EQ(*result.take_over, kBob);
  EXPECT_FALSE(result.by_order);
  EXPECT_EQ(street.person(kAda).redness, 0.5) << "she has her number back";
  EXPECT_TRUE(street.person(kAda).followed);
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kFollowing);
}

TEST(Choose, AsksWhereBothAreAlikeAndGoesOnWithTheLikeliest) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 0.53);
  street.run(2.0);
  EXPECT_EQ(street.last.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.count, 2);
  EXPECT_EQ(street.last.candidates[0].person_id, kAda) << "likeliest first";
  EXPECT_EQ(street.last.candidates[1].person_id, kBob);
  EXPECT_GT(street.last.candidates[1].likeness, 0.9);
  EXPECT_LT(street.last.waits_s, street.params.wait_s);
  street.run(street.params.wait_s - 0.5);
  EXPECT_EQ(street.run(1.0).status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.last.person_id, kAda);
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kFollowing);
}

TEST(Choose, WithoutAnAnswerItMayHold) {
  Street street;
  street.params.unanswered = 1;
  street.run(2.0);
  street.meet(kBob, 0.5);
  street.run(2.0 * street.params.wait_s);
  EXPECT_EQ(street.last.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.waits_s, 0.0);
}

TEST(Choose, AnAnswerEndsTheDoubt) {
  for (const std::uint32_t answer : {kAda, kBob}) {
    Street street;
    street.run(2.0);
    street.meet(kBob, 0.5);
    street.run(2.0);
    ASSERT_EQ(street.last.status, ChoiceStatus::kDoubtful);
    street.order = answer;
    EXPECT_EQ(street.frame().status, ChoiceStatus::kFollowing);
    EXPECT_EQ(street.last.take_over.has_value(), answer == kBob);
    EXPECT_EQ(street.run(3.0).status, ChoiceStatus::kFollowing);
    EXPECT_EQ(street.last.person_id, answer);
  }
}

TEST(Choose, WhoMeetsThemAgainWhileItAsksStaysACandidate) {
  Street street;
  street.run(2.0);
  street.meet(kBob, 0.5);
  street.run(2.0);
  street.person(kBob).place_enu_m = {3, 0.4, 0};
  street.run(2.0);
  EXPECT_EQ(street.last.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.count, 2);
}

TEST(Choose, FollowsWhomAnOperatorSays) {
  Street street;
  street.run(2.0);
  street.people.push_back({kCid, {6, 3, 0}, 2.0});
  street.order = kCid;
  const ChoiceResult& result = street.frame();
  ASSERT_TRUE(result.take_over);
  EXPECT_TRUE(result.by_order);
  EXPECT_EQ(result.person_id, kCid);
  EXPECT_EQ(street.run(3.0).status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.last.person_id, kCid);
  EXPECT_NEAR(street.state.wears->colors[0], 2.0, 0.01);
}

TEST(Choose, AnOrderForWhoIsGoneChangesNothing) {
  Street street;
  street.run(2.0);
  street.order = 77;
  EXPECT_FALSE(street.frame().take_over);
  EXPECT_EQ(street.last.person_id, kAda);
}

TEST(Choose, FollowsNobodyUntilItIsToldWhom) {
  Street street;
  street.run(2.0);
  street.order = 0;
  EXPECT_EQ(street.frame().take_over, 0u);
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kWaiting);
  EXPECT_EQ(street.last.person_id, 0u);
  street.order = kAda;
  EXPECT_EQ(street.frame().take_over, kAda);
  EXPECT_EQ(street.run(1.0).status, ChoiceStatus::kFollowing);
}

TEST(Choose, WhoIsLostIsSearchedForAndThenLost) {
  Street street;
  street.run(2.0);
  street.lose();
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kSearching);
  EXPECT_EQ(street.last.person_id, kAda);
  EXPECT_EQ(street.run(street.params.search_s).status, ChoiceStatus::kLost);
}

TEST(Choose, WhoComesBackAfterMinutesIsKnownByTheirClothes) {
  Street street;
  street.run(2.0);
  street.lose();
  street.run(300.0);
  street.people.push_back({kCid, {4, 1, 0}, 1.4});  // somebody else
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kLost);
  street.people.push_back({kBob, {5, -1, 0}, 0.56});
  const ChoiceResult& result = street.run(5.0);
  ASSERT_TRUE(result.take_over);
  EXPECT_EQ(*result.take_over, kBob);
  EXPECT_FALSE(result.by_order);
  EXPECT_EQ(street.run(2.0).status, ChoiceStatus::kFollowing);
  EXPECT_EQ(street.last.person_id, kAda);
}

TEST(Choose, OfTwoWhoComeAlikeTheOperatorSaysWho) {
  Street street;
  street.run(2.0);
  street.lose();
  street.run(30.0);
  street.people.push_back({kBob, {4, 1, 0}, 0.5});
  street.people.push_back({kCid, {4, -1, 0}, 0.55});
  street.run(2.0);
  EXPECT_EQ(street.last.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.count, 2);
  EXPECT_EQ(street.last.candidates[0].person_id, kBob);
  const ChoiceResult& result = street.run(street.params.wait_s + 1.0);
  ASSERT_TRUE(result.take_over);
  EXPECT_EQ(*result.take_over, kBob) << "the likeliest";
}

TEST(Choose, WhoIsFoundAgainInOtherClothesIsAskedAbout) {
  Street street;
  street.run(2.0);
  const auto ada = street.person(kAda);
  street.lose();
  street.run(10.0);
  street.people.push_back(ada);
  street.person(kAda).redness = 1.2;  // somebody else, at her place
  street.run(2.0);
  EXPECT_EQ(street.last.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(street.last.count, 1);
}

TEST(Choose, WithoutImagesNothingIsAsked) {
  Street street;
  street.images = false;
  street.run(2.0);
  street.meet(kBob, 0.5);
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kFollowing);
  street.lose();
  EXPECT_EQ(street.run(5.0).status, ChoiceStatus::kSearching);
}

TEST(Choose, ASimulationThatBeginsAnewIsForgotten) {
  Street street;
  street.order = 0;
  street.frame();
  street.now_s = 0.0;
  street.person(kAda).followed = true;
  EXPECT_EQ(street.frame().status, ChoiceStatus::kFollowing);
}

TEST(Choose, KeepsTheFourLikeliestOfMany) {
  Street street;
  street.run(2.0);
  street.lose();
  for (std::uint32_t id = 10; id < 17; ++id)
    street.people.push_back({id, {4, static_cast<double>(id) - 13.0, 0}, 0.5 + 0.01 * id - 0.1});
  street.run(2.0);
  ASSERT_EQ(street.last.count, 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(street.last.candidates[i].person_id, 10u + i);
}

TEST(Choose, LikenessFallsWithTheDifference) {
  EXPECT_EQ(likeness_of(0.0), 1.0);
  EXPECT_GT(likeness_of(0.1), 0.85);
  EXPECT_LT(likeness_of(0.6), 0.02);
}

}  // namespace
}  // namespace foretrack
