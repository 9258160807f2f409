// SPDX-License-Identifier: Apache-2.0
#include "core/perception/sample_image.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

RgbImage noise(int width_px, int height_px) {
  RgbImage image{width_px, height_px, {}};
  Random random(1);
  for (int k = 0; k < 3 * width_px * height_px; ++k)
    image.rgb.push_back(static_cast<std::uint8_t>(random.integer(0, 255)));
  return image;
}

std::vector<float> sample(const RgbImage& image, const ImageRegion& region, Border border,
                          int side) {
  std::vector<float> out(3u * side * side);
  sample_region(image, region, border, side, 255.0f, 0.0f, out);
  return out;
}

TEST(SampleRegion, OfTheSameSizeIsTheImage) {
  const auto image = noise(16, 16);
  const auto out = sample(image, {{8, 8}, 16, 0.0}, Border::kBlack, 16);
  for (std::size_t k = 0; k < out.size(); ++k) EXPECT_NEAR(out[k], image.rgb[k], 1e-3);
}

TEST(SampleRegion, HalfTheSizeIsTheMeanOfFourPixels) {
  const auto image = noise(16, 16);
  const auto out = sample(image, {{8, 8}, 16, 0.0}, Border::kBlack, 8);
  const double mean =
      (image.pixel(6, 4)[1] + image.pixel(7, 4)[1] + image.pixel(6, 5)[1] + image.pixel(7, 5)[1]) /
      4.0;
  EXPECT_NEAR(out[3 * (2 * 8 + 3) + 1], mean, 1e-3);
}

TEST(SampleRegion, AQuarterTurnTurnsTheImage) {
  const auto image = noise(8, 8);
  const auto out = sample(image, {{4, 4}, 8, kPi / 2.0}, Border::kBlack, 8);
  // Clockwise in the image: the region's top is the image's right side.
  for (int column = 0; column < 8; ++column)
    EXPECT_NEAR(out[3 * column], image.pixel(7, column)[0], 1e-3);
}

TEST(SampleRegion, OutsideIsBlackOrTheNearestPixel) {
  const auto image = noise(8, 8);
  const ImageRegion beside{{-4, 4}, 8, 0.0};
  for (const float v : sample(image, beside, Border::kBlack, 8)) EXPECT_EQ(v, 0.0f);
  const auto repeated = sample(image, beside, Border::kRepeated, 8);
  for (int row = 0; row < 8; ++row)
    EXPECT_NEAR(repeated[3 * (8 * row + 2)], image.pixel(0, row)[0], 1e-3);
}

TEST(SampleRegion, FarAwayRegionsAreSafe) {
  const auto image = noise(8, 8);
  for (const double far : {1e6, 1e12, 1e300})
    for (const auto border : {Border::kBlack, Border::kRepeated})
      for (const float v : sample(image, {{far, -far}, far, 0.3}, border, 4))
        EXPECT_TRUE(v >= 0.0f && v <= 255.0f);
}

}  // namespace
}  // namespace foretrack
