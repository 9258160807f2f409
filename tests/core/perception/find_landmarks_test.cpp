// SPDX-License-Identifier: Apache-2.0
#include "core/perception/find_landmarks.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/fake_network.hpp"

namespace foretrack {
namespace {

using testing::grey_image;

TEST(FindLandmarks, HeatMovesALandmarkToItsCentre) {
  testing::FakePoseNetwork fake;
  const auto image = grey_image(64, 64);
  const ImageRegion whole{{32, 32}, 64, 0.0};
  auto& heat = fake.landmarks->answer(2);
  for (const auto& [row, column] : {std::pair{30, 30}, {31, 32}})
    heat[(row * 64 + column) * 39 + kLeftHip] = 20.0f;
  fake.landmarks->answer(0)[5 * kLeftHip] = fake.landmarks->answer(0)[5 * kLeftHip + 1] = 124.0f;
  const auto person = find_landmarks(image, whole, *fake.landmarks, 0.5);
  ASSERT_TRUE(person);
  EXPECT_NEAR(person->landmarks[kLeftHip].image_px.x(), 31.0, 0.02);
  EXPECT_NEAR(person->landmarks[kLeftHip].image_px.y(), 30.5, 0.02);
}

TEST(FindLandmarks, AMarkBelowTheRegionIsRefinedByTheHeatAtItsEdge) {
  testing::FakePoseNetwork fake;
  fake.landmarks->answer(2)[(62 * 64 + 32) * 39 + kLeftHip] = 20.0f;
  fake.landmarks->answer(0)[5 * kLeftHip] = 130.0f;
  const auto hip_y_px = [&](float mark) {
    fake.landmarks->answer(0)[5 * kLeftHip + 1] = mark;
    const auto person =
        find_landmarks(grey_image(64, 64), {{32, 32}, 64, 0.0}, *fake.landmarks, 0.5);
    return person->landmarks[kLeftHip].image_px.y();
  };
  EXPECT_NEAR(hip_y_px(258.0f), 62.0, 0.1);
  EXPECT_NEAR(hip_y_px(400.0f), 100.0, 1e-3);  // too far below
}

TEST(FindLandmarks, WorldPointsTurnWithTheRegion) {
  testing::FakePoseNetwork fake;
  fake.landmarks->answer(3)[0] = 1.0f;
  fake.landmarks->answer(3)[2] = 0.5f;
  const auto person =
      find_landmarks(grey_image(64, 64), {{32, 32}, 64, kPi / 2.0}, *fake.landmarks, 0.5);
  ASSERT_TRUE(person);
  EXPECT_NEAR((person->landmarks[0].body_m - Vec3(0.0, 1.0, 0.5)).norm(), 0.0, 1e-6);
}

TEST(FindLandmarks, MarksAreInThePixelsOfTheImage) {
  testing::FakePoseNetwork fake;
  const ImageRegion region{{100.0, 60.0}, 40.0, 0.0};
  const auto person = find_landmarks(grey_image(200, 120), region, *fake.landmarks, 0.5);
  ASSERT_TRUE(person);
  EXPECT_LT((person->landmarks[kLeftShoulder].image_px - Vec2(104.0, 52.0)).norm(), 1e-4);
  EXPECT_LT((person->torso_px() - Vec2(100.0, 56.0)).norm(), 1e-4);
  EXPECT_NEAR(person->landmarks[kLeftShoulder].visibility, 1.0 / (1.0 + std::exp(-5.0)), 1e-6);
  EXPECT_EQ(person->region.size_px, 40.0);
  // The next image is searched around the body's middle, 1.25 times as far as its end.
  EXPECT_LT((person->tracked.centre_px - Vec2(100.0, 60.0)).norm(), 1e-4);
  EXPECT_NEAR(person->tracked.size_px, 2.0 * 1.25 * 0.4 * 40.0, 1e-4);
}

TEST(FindLandmarks, NobodyIsFoundWhereTheNetworkIsNotCertainEnough) {
  testing::FakePoseNetwork fake;
  const ImageRegion region{{100.0, 60.0}, 40.0, 0.0};
  fake.answer_person(0.7);
  EXPECT_TRUE(find_landmarks(grey_image(200, 120), region, *fake.landmarks, 0.6));
  EXPECT_FALSE(find_landmarks(grey_image(200, 120), region, *fake.landmarks, 0.8));
}

TEST(FindLandmarks, ARegionThatIsNoneIsNotLookedAt) {
  testing::FakePoseNetwork fake;
  const double nan = std::nan("");
  for (const ImageRegion& region :
       {ImageRegion{{10.0, 10.0}, 1.0, 0.0}, ImageRegion{{10.0, 10.0}, nan, 0.0},
        ImageRegion{{10.0, 10.0}, 1e9, 0.0}, ImageRegion{{nan, 10.0}, 40.0, 0.0}})
    EXPECT_FALSE(find_landmarks(grey_image(64, 64), region, *fake.landmarks, 0.5));
  EXPECT_EQ(fake.landmarks->runs, 0);
}

}  // namespace
}  // namespace foretrack
