// SPDX-License-Identifier: Apache-2.0
#include "core/perception/detect_people.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/fake_network.hpp"

namespace foretrack {
namespace {

using testing::grey_image;

TEST(DetectPeople, OverlappingBoxesAreAveragedByTheirScores) {
  testing::FakePoseNetwork fake;
  fake.see({0.49, 0.5}, 0.3, 3.0);
  fake.see({0.55, 0.5}, 0.3, 1.0);
  const RgbImage image = grey_image(400, 400);
  const auto people = detect_people(image, whole_of(image), *fake.detector, 0.5);
  ASSERT_EQ(people.size(), 1u);
  const double a = 1.0 / (1.0 + std::exp(-3.0)), b = 1.0 / (1.0 + std::exp(-1.0));
  EXPECT_NEAR(people[0].points_px[0].x(), 400.0 * (0.49 * a + 0.55 * b) / (a + b), 0.01);
  EXPECT_NEAR(people[0].score, a, 1e-6);
}

TEST(DetectPeople, PointsAreInThePixelsOfAWideImage) {
  testing::FakePoseNetwork fake;
  fake.see({0.5, 0.5}, 0.1, 3.0);
  const RgbImage image = grey_image(800, 400);
  const auto people = detect_people(image, whole_of(image), *fake.detector, 0.5);
  ASSERT_EQ(people.size(), 1u);
  EXPECT_NEAR(people[0].points_px[2].x(), 400.0, 0.01);
  EXPECT_NEAR(people[0].points_px[2].y(), 200.0 + 800 * (0.025 - 0.05), 0.01);
}

TEST(RegionOfBody, IsTurnedSoThatTheBodyIsUpright) {
  const auto region = region_of_body({100, 100}, {140, 100});  // the head is to the right
  EXPECT_NEAR(region.size_px, 100.0, 1e-9);
  EXPECT_NEAR(region.angle_rad, kPi / 2.0, 1e-9);
  const Vec2 top = region.image_px({0.5, 0.0});
  EXPECT_NEAR(top.x(), 150.0, 1e-9);
  EXPECT_NEAR(top.y(), 100.0, 1e-9);
}

// Anchor k of the grids of 28, 14 and 7 cells a side, with two, two and six anchors a cell.
Vec2 anchor_of(int k) {
  for (const auto& [cells, per_cell] : {std::pair{28, 2}, {14, 2}, {7, 6}}) {
    const int cell = k / per_cell;
    if (cell < cells * cells) return {(cell % cells + 0.5) / cells, (cell / cells + 0.5) / cells};
    k -= per_cell * cells * cells;
  }
  return {0.0, 0.0};
}

TEST(DetectPeople, EachAnchorIsInTheMiddleOfItsCell) {
  const RgbImage image = grey_image(224, 224);
  for (int k = 0; k < testing::FakePoseNetwork::kAnchors; k += 97) {
    testing::FakePoseNetwork fake;
    fake.detector->answer(1)[k] = 4.0f;
    float* numbers = &fake.detector->answer(0)[12 * k];
    numbers[2] = numbers[3] = 22.4f;  // a box of a tenth, around the anchor
    const auto people = detect_people(image, whole_of(image), *fake.detector, 0.5);
    ASSERT_EQ(people.size(), 1u) << k;
    EXPECT_LT((people[0].torso_px() - 224.0 * anchor_of(k)).norm(), 1e-4) << k;
    EXPECT_LT((people[0].box_max_px - people[0].box_min_px - Vec2(22.4, 22.4)).norm(), 1e-4) << k;
  }
}

TEST(DetectPeople, TheMostCertainIsFirstAndTheUncertainAreNobody) {
  testing::FakePoseNetwork fake;
  fake.see({0.2, 0.5}, 0.1, 1.0);
  fake.see({0.5, 0.5}, 0.1, 3.0);
  fake.see({0.8, 0.5}, 0.1, -0.5);
  const RgbImage image = grey_image(400, 400);
  const auto people = detect_people(image, whole_of(image), *fake.detector, 0.5);
  ASSERT_EQ(people.size(), 2u);
  EXPECT_NEAR(people[0].torso_px().x(), 200.0, 0.1);
  EXPECT_NEAR(people[1].torso_px().x(), 80.0, 0.1);
  EXPECT_GT(people[0].score, people[1].score);
}

TEST(DetectPeople, PointsOfATurnedWindowAreInTheImage) {
  testing::FakePoseNetwork fake;
  fake.see({0.5, 0.25}, 0.1, 3.0);
  for (const double angle_rad : {kPi / 2.0, kPi, -kPi / 4.0}) {
    const ImageRegion window{{100.0, 100.0}, 80.0, angle_rad};
    const auto people = detect_people(grey_image(400, 400), window, *fake.detector, 0.5);
    ASSERT_EQ(people.size(), 1u) << angle_rad;
    const Vec2 torso = Vec2(100.0, 100.0) + Eigen::Rotation2Dd(angle_rad) * Vec2(0.0, -20.0);
    EXPECT_LT((people[0].torso_px() - torso).norm(), 0.01) << angle_rad;
    EXPECT_TRUE((people[0].box_min_px.array() < people[0].box_max_px.array()).all());
  }
}

TEST(DetectPeople, ABoxWithoutAreaIsNobody) {
  testing::FakePoseNetwork fake;
  fake.see({0.5, 0.5}, 0.1, 3.0);
  for (int k = 0; k < testing::FakePoseNetwork::kAnchors; ++k)
    fake.detector->answer(0)[12 * k + 2] = 0.0f;
  const RgbImage image = grey_image(400, 400);
  EXPECT_TRUE(detect_people(image, whole_of(image), *fake.detector, 0.5).empty());
}

TEST(WholeOf, IsTheLeastSquareThatHoldsTheImage) {
  const ImageRegion wide = whole_of(grey_image(80, 20)), high = whole_of(grey_image(20, 80));
  EXPECT_EQ(wide.centre_px, Vec2(40.0, 10.0));
  EXPECT_EQ(high.centre_px, Vec2(10.0, 40.0));
  EXPECT_EQ(wide.size_px, 80.0);
  EXPECT_EQ(high.size_px, 80.0);
}

}  // namespace
}  // namespace foretrack
