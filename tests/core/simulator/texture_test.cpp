// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/texture.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

RgbImage random_image(int width_px, int height_px, std::uint64_t seed) {
  Random random(seed);
  RgbImage image{width_px, height_px, std::vector<std::uint8_t>(3UL * width_px * height_px)};
  for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(random.integer(0, 255));
  return image;
}

std::uint32_t texel(const Texture& texture, std::size_t level, int x, int y) {
  const Texture::Level& l = texture.levels[level];
  return texture.texels[l.first + (static_cast<std::size_t>(y) << l.width_log2) +
                        static_cast<std::size_t>(x)];
}

TEST(Texture, KeepsAPictureOfPowersOfTwoUpsideDown) {
  const RgbImage image = random_image(8, 4, 1);
  const Texture texture = make_texture(image);
  EXPECT_EQ(texture.levels[0].width_log2, 3);
  EXPECT_EQ(texture.levels[0].height_log2, 2);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      const std::uint8_t* rgb = image.pixel(x, 3 - y);  // its last row is at v = 0
      EXPECT_EQ(texel(texture, 0, x, y),
                static_cast<std::uint32_t>(rgb[0] | rgb[1] << 8 | rgb[2] << 16));
    }
}

TEST(Texture, EachLevelIsTheMeanOfTheOneBelowDownToOneTexel) {
  const Texture texture = make_texture(random_image(16, 4, 2));
  ASSERT_EQ(texture.levels.size(), 5U);
  for (std::size_t l = 1; l < texture.levels.size(); ++l) {
    const auto &from = texture.levels[l - 1], &to = texture.levels[l];
    const int dx = from.width_log2 > to.width_log2 ? 2 : 1;
    const int dy = from.height_log2 > to.height_log2 ? 2 : 1;
    for (int y = 0; y < 1 << to.height_log2; ++y)
      for (int x = 0; x < 1 << to.width_log2; ++x)
        for (const int shift : {0, 8, 16}) {
          double mean = 0.0;
          for (int j = 0; j < dy; ++j)
            for (int i = 0; i < dx; ++i)
              mean += texel(texture, l - 1, dx * x + i, dy * y + j) >> shift & 0xff;
          EXPECT_NEAR(texel(texture, l, x, y) >> shift & 0xff, mean / (dx * dy), 0.51);
        }
  }
  EXPECT_EQ(texture.levels.back().width_log2, 0);
  EXPECT_EQ(texture.texels.size(), 64U + 16U + 4U + 2U + 1U);
}

TEST(Texture, OtherSizesAreBroughtToTheNearestPowerOfTwo) {
  const auto size = [](int width_px, int height_px) {
    const Texture::Level l = make_texture(random_image(width_px, height_px, 3)).levels[0];
    return std::pair{1 << l.width_log2, 1 << l.height_log2};
  };
  EXPECT_EQ(size(100, 33), (std::pair{128, 32}));
  EXPECT_EQ(size(1, 5), (std::pair{1, 4}));
  EXPECT_EQ(size(3000, 2), (std::pair{1024, 2})) << "no longer than 1024";
}

TEST(Texture, AnEmptyImageIsRefused) {
  EXPECT_THROW(make_texture({}), std::invalid_argument);
  EXPECT_THROW(make_texture({0, 3, {}}), std::invalid_argument);
}

TEST(SurfaceTexture, EachIsTheSameEveryTimeAndUnlikeTheOthers) {
  std::vector<Texture> seen;
  for (int k = 0; k < kSurfaceCount; ++k) {
    const Texture texture = make_surface_texture(static_cast<Surface>(k));
    EXPECT_EQ(texture.texels, make_surface_texture(static_cast<Surface>(k)).texels);
    for (const Texture& other : seen) EXPECT_NE(texture.texels, other.texels);
    seen.push_back(texture);
  }
}

// Where a picture meets its own repeat there is no seam: neighbours across the edge differ no more
// than neighbours inside.
TEST(SurfaceTexture, NoiseRepeatsWithoutASeam) {
  const Texture roof = make_surface_texture(Surface::kRoof);
  const int side = 1 << roof.levels[0].width_log2;
  const auto step = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < side; ++y)
      sum += std::abs(static_cast<double>(texel(roof, 0, x, y) & 0xff) -
                      static_cast<double>(texel(roof, 0, (x + 1) % side, y) & 0xff));
    return sum / side;
  };
  double inside = 0.0;
  for (int x = 0; x < side - 1; ++x) inside += step(x) / (side - 1);
  EXPECT_LT(step(side - 1), 1.5 * inside);
}

}  // namespace
}  // namespace foretrack
