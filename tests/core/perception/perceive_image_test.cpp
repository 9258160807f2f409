// SPDX-License-Identifier: Apache-2.0
#include "core/perception/perceive_image.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/perception/detect_people.hpp"
#include "tests/core/perception/fake_network.hpp"

namespace foretrack {
namespace {

using testing::grey_image;

class PerceiveImage : public ::testing::Test {
 protected:
  PoseResult look(double stamp_s, const std::optional<ExpectedPlace>& expected = {}) {
    return perceive_image(state_, image_, stamp_s, fake_.network, params_, expected);
  }
  testing::FakePoseNetwork fake_;
  PoseState state_;
  PerceptionParams params_;
  RgbImage image_ = grey_image(400, 400);
};

TEST_F(PerceiveImage, DetectsOnceAndThenTracksWithoutTheDetector) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  EXPECT_EQ(look(0.0).status, PoseStatus::kDetected);
  for (int k = 1; k < 5; ++k) EXPECT_EQ(look(0.03 * k).status, PoseStatus::kTracked);
  EXPECT_EQ(fake_.detector->runs, 1);
  EXPECT_EQ(fake_.landmarks->runs, 5);
}

TEST_F(PerceiveImage, TheRegionOfADetectionHoldsTheBodyUprightAndAQuarterMore) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  const auto result = look(0.0);
  ASSERT_TRUE(result.found());
  EXPECT_NEAR(result.person.region.size_px, 2.0 * 0.3 * 1.25 * 400, 0.1);
  EXPECT_NEAR(result.person.region.angle_rad, 0.0, 1e-6);
  EXPECT_NEAR(result.person.region.centre_px.x(), 160.0, 0.1);
  EXPECT_NEAR(result.person.region.centre_px.y(), 400 * (0.5 + 0.25 * 0.3), 0.1);
}

TEST_F(PerceiveImage, TheDetectorRunsNoMoreOftenThanItsPeriod) {
  params_.detector_period_s = 0.2;
  int looked = 0;
  for (int k = 0; k < 30; ++k) looked += look(k / 30.0).status == PoseStatus::kNobody;
  EXPECT_EQ(looked, 5);
  EXPECT_EQ(fake_.detector->runs, 5);
}

TEST_F(PerceiveImage, AnEmptyRegionIsLeftForTheDetectorAtOnce) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  look(0.0);
  fake_.answer_person(0.2);
  EXPECT_EQ(look(0.3).status, PoseStatus::kNobody);
  EXPECT_EQ(fake_.detector->runs, 2);
  EXPECT_FALSE(state_.chosen.region);
}

TEST_F(PerceiveImage, ATorsoThatJumpsIsSomebodyElse) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  look(0.0);
  fake_.answer_person(0.99, {0.45, 0.0});
  EXPECT_NE(look(0.03).status, PoseStatus::kTracked);
}

TEST_F(PerceiveImage, TheFirstTimeTheMostCertainPersonIsChosenAndTheDoubtIsSaid) {
  fake_.see({0.2, 0.5}, 0.2, 1.0);
  fake_.see({0.8, 0.5}, 0.2, 3.0);
  const auto result = look(0.0);
  EXPECT_NEAR(result.person.region.centre_px.x(), 320.0, 1.0);
  EXPECT_EQ(result.candidates, 2);
  EXPECT_TRUE(result.ambiguous);
}

TEST_F(PerceiveImage, ALostPersonIsFoundAgainByPlaceNotByCertainty) {
  fake_.see({0.2, 0.5}, 0.2, 1.0);
  look(0.0);
  fake_.answer_person(0.1);
  look(0.03);
  fake_.answer_person();
  fake_.see({0.8, 0.5}, 0.2, 5.0);
  const auto result = look(0.5);
  ASSERT_EQ(result.status, PoseStatus::kDetected);
  EXPECT_NEAR(result.person.region.centre_px.x(), 80.0, 1.0);
  EXPECT_FALSE(result.ambiguous);
}

TEST_F(PerceiveImage, SomebodyElseOutsideTheGateIsNotTaken) {
  fake_.see({0.1, 0.5}, 0.1, 1.0);
  look(0.0);
  fake_.see_nobody();
  fake_.answer_person(0.1);
  look(0.03);
  fake_.answer_person();
  fake_.see({0.9, 0.5}, 0.1, 5.0);
  const auto result = look(0.5);
  EXPECT_EQ(result.status, PoseStatus::kNobody);
  EXPECT_EQ(result.candidates, 1);
  EXPECT_EQ(look(0.5 + params_.choice_memory_s).status, PoseStatus::kDetected);
}

TEST_F(PerceiveImage, WhoWalkedOnUnseenIsFoundAgain) {
  constexpr double kHeight_m = 1.6, kPace_m_s = 1.5, kUnseen_s = 2.5, kBody = 0.2;  // of the image
  image_ = grey_image(800, 800);
  fake_.see({0.15, 0.5}, 0.5 * kBody, 3.0);
  ASSERT_TRUE(look(0.0).found());
  state_.chosen.region.reset();
  fake_.see_nobody();
  fake_.see({0.15 + kPace_m_s * kUnseen_s * kBody / kHeight_m, 0.5}, 0.5 * kBody, 3.0);
  EXPECT_EQ(look(kUnseen_s).status, PoseStatus::kDetected);
}

TEST_F(PerceiveImage, TheExpectedPlaceDecidesAndItsGateHolds) {
  fake_.see({0.2, 0.5}, 0.2, 5.0);
  fake_.see({0.8, 0.5}, 0.2, 1.0);
  constexpr double kBody_px = 200.0;  // so large that the whole image is looked at
  const auto there = look(0.0, ExpectedPlace{{310.0, 200.0}, 60.0, kBody_px});
  ASSERT_TRUE(there.found());
  EXPECT_NEAR(there.person.region.centre_px.x(), 320.0, 1.0);
  state_ = {};
  EXPECT_FALSE(look(1.0, ExpectedPlace{{200.0, 200.0}, 60.0, kBody_px}).found());
}

TEST_F(PerceiveImage, WhoWearsSomethingElseIsNotTakenHoweverLate) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  ASSERT_TRUE(look(0.0).found());
  for (std::size_t k = 0; k < image_.rgb.size(); k += 3) image_.rgb[k] = 250;  // red, not grey
  const auto other = look(0.03);
  EXPECT_EQ(other.status, PoseStatus::kNobody);
  EXPECT_GT(other.difference, params_.clothes_gate);
  EXPECT_FALSE(look(0.1 + params_.choice_memory_s).found());
  ASSERT_EQ(state_.passed_over.size(), 1u) << "but somebody is there";
  EXPECT_TRUE(state_.passed_over[0].wears);
}

TEST_F(PerceiveImage, OfTwoWhoWearTheSameNeitherIsTakenOnceTheChosenOneIsLost) {
  fake_.see({0.3, 0.5}, 0.2, 3.0);
  ASSERT_TRUE(look(0.0).found());
  state_.chosen.region.reset();
  fake_.see({0.7, 0.5}, 0.2, 2.0);
  EXPECT_FALSE(look(1.0 + params_.choice_memory_s).found());
  EXPECT_EQ(state_.passed_over.size(), 2u);
}

TEST_F(PerceiveImage, TheFirstOneIsChosenAsTheCallerSays) {
  fake_.see({0.15, 0.5}, 0.1, 9.0);  // the most certain one,
  fake_.see({0.5, 0.5}, 0.15, 3.0);  // who is in the middle,
  fake_.see({0.85, 0.5}, 0.3, 2.0);  // and the nearest
  const std::pair<FirstChoice, double> cases[] = {
      {FirstChoice::kCertain, 0.15}, {FirstChoice::kMiddle, 0.5}, {FirstChoice::kNearest, 0.85}};
  for (const auto& [first, x] : cases) {
    state_ = {};
    state_.first = first;
    const auto result = look(1.0);
    ASSERT_TRUE(result.found());
    EXPECT_NEAR(result.person.region.centre_px.x(), x * image_.width_px, 1.0);
    EXPECT_EQ(state_.passed_over.size(), 2u);
  }
}

TEST_F(PerceiveImage, WhoWearsTheDescribedColorIsChosenAndNobodyElse) {
  fake_.see({0.3, 0.5}, 0.2, 9.0);  // in grey, and the more certain one
  fake_.see({0.7, 0.5}, 0.2, 2.0);
  state_.first = FirstChoice::kColor;
  state_.first_rgb = {220.0, 40.0, 40.0};
  EXPECT_FALSE(look(0.0).found());
  EXPECT_EQ(state_.passed_over.size(), 2u);
  const int middle_px = image_.width_px / 2;
  for (int y = 0; y < image_.height_px; ++y)
    for (int x = middle_px; x < image_.width_px; ++x) {
      auto* rgb = &image_.rgb[3 * static_cast<std::size_t>(y * image_.width_px + x)];
      rgb[0] = 160, rgb[1] = rgb[2] = 30;  // the same red in less light
    }
  state_.looks = 0;  // the whole image again
  const auto result = look(1.0);
  ASSERT_TRUE(result.found());
  EXPECT_NEAR(result.person.region.centre_px.x(), 0.7 * image_.width_px, 1.0);
}

TEST_F(PerceiveImage, NobodyIsFollowedAndEverybodyIsLookedAt) {
  fake_.see({0.3, 0.5}, 0.2, 3.0);
  ASSERT_TRUE(look(0.0).found());
  state_.follows = false;
  EXPECT_FALSE(look(0.5).found());
  EXPECT_EQ(state_.passed_over.size(), 1u);
  EXPECT_FALSE(state_.chosen.known());
  EXPECT_EQ(look(0.5 + 0.5 * params_.watch_period_s).status, PoseStatus::kNotLooked);
}

TEST_F(PerceiveImage, AnotherOneIsFollowedWhereTheFilterExpectsThem) {
  fake_.see({0.2, 0.5}, 0.2, 5.0);
  const auto first = look(0.0);
  ASSERT_TRUE(first.found());
  fake_.see({0.8, 0.5}, 0.2, 1.0);
  follow_other(state_, first.wears);
  const auto there = look(0.1, ExpectedPlace{{310.0, 200.0}, 60.0, 200.0});
  ASSERT_TRUE(there.found());
  EXPECT_NEAR(there.person.region.centre_px.x(), 320.0, 1.0);
  EXPECT_TRUE(state_.other.known()) << "who was followed is told from them";
}

TEST_F(PerceiveImage, ADarkerLightIsNoOtherPerson) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  ASSERT_TRUE(look(0.0).found());
  for (auto& byte : image_.rgb) byte = static_cast<std::uint8_t>(0.6 * byte);
  EXPECT_EQ(look(0.03).status, PoseStatus::kTracked);
}

TEST_F(PerceiveImage, APoseThatTheFilterRefusedIsNotTrackedOn) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  ExpectedPlace place{{160.0, 200.0}, 60.0, 200.0};
  ASSERT_EQ(look(0.0, place).status, PoseStatus::kDetected);
  ASSERT_EQ(look(0.03, place).status, PoseStatus::kTracked);
  place.refused = true;
  EXPECT_EQ(look(0.06, place).status, PoseStatus::kDetected);
}

TEST_F(PerceiveImage, TimeThatGoesBackStartsAnew) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  look(10.0);
  EXPECT_EQ(look(1.0).status, PoseStatus::kDetected);
}

TEST_F(PerceiveImage, BadImagesAreRefusedAndTheTrackStays) {
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  look(0.0);
  const RgbImage good = image_;
  for (const auto& [width, height] : {std::pair{0, 0}, {400, 399}, {-1, 400}, {100000, 1}}) {
    image_.width_px = width;
    image_.height_px = height;
    EXPECT_EQ(look(0.01).status, PoseStatus::kBadImage);
  }
  image_ = good;
  EXPECT_EQ(look(0.03).status, PoseStatus::kTracked);
}

TEST_F(PerceiveImage, AnImageOfOnePixelIsLookedAt) {
  image_ = grey_image(1, 1);
  EXPECT_EQ(look(0.0).status, PoseStatus::kNobody);
}

TEST_F(PerceiveImage, NoNaNComesOutOfANetworkThatGivesNaN) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  fake_.see({0.4, 0.5}, 0.3, 3.0);
  fake_.landmarks->answer(3)[7] = nan;
  EXPECT_FALSE(look(0.0).found());
  fake_.landmarks->answer(3)[7] = 0.0f;
  for (float& heat : fake_.landmarks->answer(2)) heat = nan;
  const auto result = look(1.0);
  ASSERT_TRUE(result.found());
  for (const auto& landmark : result.person.landmarks) EXPECT_TRUE(landmark.image_px.allFinite());
  for (float& number : fake_.detector->answer(0)) number = nan;
  EXPECT_TRUE(detect_people(image_, whole_of(image_), *fake_.detector, 0.5).empty());
}

TEST(ToObservation, TurnsJointsFromTheRaysAxesToTheCameras) {
  const CameraModel camera;
  PersonPose person;
  person.region.centre_px = {camera.cx_px + camera.fx_px, camera.cy_px};  // 45° to the right
  person.landmarks[0].body_m = {0.0, 0.0, kNetworkHeight_m};              // away from the viewer
  const PerceptionParams params;
  const auto observation = to_observation(person, 0.0, camera, params);
  const Vec3 away = params.landmark_height_m * Vec3(std::sqrt(0.5), 0.0, std::sqrt(0.5));
  EXPECT_NEAR((observation.landmarks[0].body_m - away).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace foretrack
