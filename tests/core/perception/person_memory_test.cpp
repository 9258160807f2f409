// SPDX-License-Identifier: Apache-2.0
#include "core/perception/person_memory.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/torso_pose.hpp"

namespace foretrack {
namespace {

using testing::pose_at;

Appearance wearing(double color) {
  Appearance clothes;
  clothes.colors[0] = color;
  return clothes;
}

TEST(PersonMemory, GoesOnAsItMovedAndIsLessCertain) {
  PersonMemory person;
  for (int k = 0; k < 60; ++k)
    remember(person, pose_at({100.0 + 2.0 * k, 200.0}, 150.0), {}, k / 30.0, true);
  const TorsoPlace now = place_at(person, 59 / 30.0), later = place_at(person, 59 / 30.0 + 0.5);
  EXPECT_NEAR(later.px.x() - now.px.x(), 30.0, 0.1);
  EXPECT_GT(later.sigma_px, now.sigma_px);
}

TEST(PersonMemory, PlaceSizeAndClothesEachTellOneFromAnother) {
  PersonMemory person;
  remember(person, pose_at({100.0, 200.0}, 150.0), wearing(0.0), 1.0, true);
  const auto unlike = [&](const PersonPose& pose, double color) {
    return unlikeness(person, place_at(person, 1.0), 1.0, pose, wearing(color));
  };
  EXPECT_NEAR(unlike(pose_at({100.0, 200.0}, 150.0), 0.0), 0.0, 1e-9);
  EXPECT_GT(unlike(pose_at({120.0, 200.0}, 150.0), 0.0), 9.0);
  EXPECT_GT(unlike(pose_at({100.0, 200.0}, 175.0), 0.0), 9.0);
  EXPECT_GT(unlike(pose_at({100.0, 200.0}, 150.0), 0.5), 9.0);
}

TEST(PersonMemory, NothingIsLearntOfClothesAndLittleOfSizeWhileSomebodyIsNear) {
  PersonMemory person;
  remember(person, pose_at({100.0, 200.0}, 150.0), wearing(0.0), 1.0, true);
  remember(person, pose_at({100.0, 200.0}, 180.0), wearing(1.0), 1.1, false);
  EXPECT_EQ(person.wears->colors[0], 0.0);
  EXPECT_LT(person.size_px, 152.0);
  remember(person, pose_at({100.0, 200.0}, 180.0), wearing(1.0), 1.2, true);
  EXPECT_GT(person.wears->colors[0], 0.0);
  EXPECT_EQ(person.size_px, 180.0);
}

TEST(PersonMemory, AfterAPauseNothingIsKnownOfTheVelocity) {
  PersonMemory person;
  for (int k = 0; k < 30; ++k)
    remember(person, pose_at({100.0 + 2.0 * k, 200.0}, 150.0), {}, k / 30.0, true);
  EXPECT_GT(person.velocity_px_s.x(), 50.0);
  remember(person, pose_at({400.0, 200.0}, 150.0), {}, 3.0, true);
  EXPECT_EQ(person.velocity_px_s, Vec2(0.0, 0.0));
}

TEST(PersonMemory, UnlikenessIsTheSumOfItsParts) {
  PersonMemory person;
  remember(person, pose_at({100.0, 200.0}, 150.0), wearing(0.0), 1.0, true);
  const TorsoPlace place = place_at(person, 1.0);
  const auto unlike = [&](double dx, double size, double color) {
    return unlikeness(person, place, 1.0, pose_at({100.0 + dx, 200.0}, size), wearing(color));
  };
  const double aside = unlike(12.0, 150.0, 0.0), larger = unlike(0.0, 165.0, 0.0),
               dressed = unlike(0.0, 150.0, 0.2);
  EXPECT_NEAR(aside, std::pow(12.0 / place.sigma_px, 2), 1e-9);
  EXPECT_NEAR(unlike(12.0, 165.0, 0.2), aside + larger + dressed, 1e-9);
}

TEST(PersonMemory, WhatClothesAreNotSeenSayNothing) {
  PersonMemory person;
  remember(person, pose_at({100.0, 200.0}, 150.0), wearing(0.0), 1.0, true);
  EXPECT_NEAR(
      unlikeness(person, place_at(person, 1.0), 1.0, pose_at({100.0, 200.0}, 150.0), std::nullopt),
      0.0, 1e-9);
}

TEST(PersonMemory, UncertaintyGrowsNoMoreAfterFiveSeconds) {
  PersonMemory person;
  remember(person, pose_at({100.0, 200.0}, 150.0), {}, 1.0, true);
  EXPECT_LT(place_at(person, 5.0).sigma_px, place_at(person, 6.0).sigma_px);
  EXPECT_EQ(place_at(person, 6.0).sigma_px, place_at(person, 600.0).sigma_px);
}

}  // namespace
}  // namespace foretrack
