// SPDX-License-Identifier: Apache-2.0
#include "core/perception/watch_others.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/fake_network.hpp"

namespace foretrack {
namespace {

using testing::grey_image;

// The fake landmark network puts a person into the middle of any region; the detector sees whom
// the test wants.
class WatchOthers : public ::testing::Test {
 protected:
  PoseResult look(double stamp_s) {
    const auto result = perceive_image(state_, image_, stamp_s, fake_.network, params_);
    others_ = watch_others(state_, image_, stamp_s, fake_.network, params_);
    return result;
  }
  // The chosen person, and then somebody beside.
  void look_at_two() {
    fake_.see({0.4, 0.5}, 0.2, 3.0);
    look(0.0);
    fake_.see({0.6, 0.5}, 0.2, 3.0);
    look(0.2);
    ASSERT_TRUE(state_.other.known());
  }
  // The other one is so many sizes of the body to the right.
  void look_with_other_at(double sizes) {
    fake_.see({0.4, 0.5}, 0.2, 3.0);
    look(0.0);
    state_.other = state_.chosen;
    state_.other.torso_px.x() += sizes * state_.chosen.size_px;
    state_.other.wears.reset();
  }
  testing::FakePoseNetwork fake_;
  PoseState state_;
  std::vector<OtherPerson> others_;  // in the last image
  PerceptionParams params_;
  RgbImage image_ = grey_image(400, 400);
};

TEST_F(WatchOthers, NobodyElseCostsOneDetectorInAPeriod) {
  fake_.see({0.4, 0.5}, 0.25, 3.0);  // so large that the surroundings are the whole image
  params_.watch_period_s = 0.1;
  for (int k = 0; k < 30; ++k) look(k / 30.0);
  EXPECT_FALSE(state_.other.known());
  EXPECT_GE(fake_.detector->runs, 7);
  EXPECT_LE(fake_.detector->runs, 11);
  EXPECT_EQ(fake_.landmarks->runs, 30);
}

// What the fake detector sees is at the same place of any window: at 0.85 of the left one it is the
// chosen person, of the right one somebody who is well to the right.
TEST_F(WatchOthers, BothSidesAreLookedAtInTurns) {
  image_ = grey_image(800, 800);
  fake_.see({0.5, 0.5}, 0.1, 3.0);
  ASSERT_TRUE(perceive_image(state_, image_, 0.0, fake_.network, params_).found());
  fake_.see_nobody();
  fake_.see({0.85, 0.5}, 0.2, 3.0);
  look(0.2);
  EXPECT_FALSE(state_.other.known());
  look(0.4);
  ASSERT_TRUE(state_.other.known());
  EXPECT_GT(state_.other.torso_px.x() - state_.chosen.torso_px.x(), state_.chosen.size_px);
}

TEST_F(WatchOthers, WhoIsBesideIsKnownAndNotTheChosenOne) {
  look_at_two();
  EXPECT_NEAR(state_.chosen.torso_px.x(), 160.0, 15.0);
  EXPECT_GT(state_.other.torso_px.x(), 220.0);
}

TEST_F(WatchOthers, EverybodyElseInTheImageIsTold) {
  look_at_two();
  fake_.see_nobody();
  look(0.23);
  ASSERT_EQ(others_.size(), 1u);
  ASSERT_TRUE(others_[0].pose.has_value());
  EXPECT_GT(others_[0].pose->torso_px().x(), 220.0);
  fake_.see({0.9, 0.5}, 0.2, 3.0);  // a third one, whom the detector alone sees
  look(0.4);
  look(0.6);  // on the other side
  ASSERT_EQ(others_.size(), 2u);
  EXPECT_TRUE(others_[0].pose.has_value());
  EXPECT_FALSE(others_[1].pose.has_value());
  EXPECT_GT(others_[1].region.centre_px.x(), 300.0);
}

TEST_F(WatchOthers, APoseAtTheOthersPlaceIsNotTakenWhenTheChosenOneIsGone) {
  look_at_two();
  fake_.see_nobody();
  fake_.see({0.6, 0.5}, 0.2, 3.0);
  state_.chosen.region.reset();  // lost
  const auto result = look(0.23);
  EXPECT_EQ(result.status, PoseStatus::kNobody);
  EXPECT_TRUE(result.ambiguous);
}

TEST_F(WatchOthers, HalfOfEachIsNobodysPoseAndTheDoubtIsSaid) {
  look_with_other_at(0.2);
  fake_.answer_person(0.99, {0.1, 0.0});
  const auto result = look(0.03);
  EXPECT_FALSE(result.found());
  EXPECT_TRUE(result.ambiguous);
}

TEST_F(WatchOthers, WhoWentFarAwayIsForgotten) {
  look_with_other_at(2.0);
  look(0.03);
  EXPECT_FALSE(state_.other.known());
}

TEST_F(WatchOthers, WhoWasNotSeenForALongTimeIsForgotten) {
  look_with_other_at(1.0);
  fake_.see_nobody();
  fake_.answer_person(0.1);  // nobody is in any region
  look(1.4);
  EXPECT_TRUE(state_.other.known());
  look(1.6);
  EXPECT_FALSE(state_.other.known());
}

TEST_F(WatchOthers, ANearerOneTakesThePlaceOfTheOther) {
  look_with_other_at(1.3);
  const double before_px = state_.other.torso_px.x();
  fake_.see({0.6, 0.5}, 0.2, 3.0);
  look(0.2);
  ASSERT_TRUE(state_.other.known());
  EXPECT_LT(state_.other.torso_px.x(), before_px - 20.0);
}

TEST_F(WatchOthers, NobodyIsLookedForBeforeSomebodyIsChosen) {
  watch_others(state_, image_, 0.0, fake_.network, params_);
  EXPECT_EQ(fake_.detector->runs, 0);
  EXPECT_EQ(fake_.landmarks->runs, 0);
}

}  // namespace
}  // namespace foretrack
