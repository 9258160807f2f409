// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/shade.hpp"

#include <gtest/gtest.h>

#include <array>

namespace foretrack {
namespace {

const CameraModel kCamera = CameraModel::from_fov(160, 120, rad(90.0), rad(75.0));

Texture plain(int red, int green, int blue) {
  return make_texture({1,
                       1,
                       {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                        static_cast<std::uint8_t>(blue)}});
}

/// A wall at z that fills the view; `light` on its left and right side, u and v from 0 to
/// `repeats`.
Canvas wall(const Texture& texture, double z_m, float left = 1.0F, float right = 1.0F,
            float repeats = 1.0F) {
  Canvas canvas = make_canvas(kCamera);
  const auto h = static_cast<float>(2.0 * z_m), z = static_cast<float>(z_m);
  draw(canvas,
       std::array{Corner{{-h, -h, z}, 0.0F, repeats, left}, Corner{{-h, h, z}, 0.0F, 0.0F, left},
                  Corner{{h, h, z}, repeats, 0.0F, right},
                  Corner{{h, -h, z}, repeats, repeats, right}},
       texture);
  shade(canvas, {});
  return canvas;
}

TEST(Shade, AColourIsThatOfItsTextureTimesTheLight) {
  constexpr std::array<int, 3> kColor{100, 40, 200};
  const Texture texture = plain(kColor[0], kColor[1], kColor[2]);
  for (const float light : {0.5F, 1.0F, 1.2F}) {
    const Canvas canvas = wall(texture, 3.0, light, light);
    for (const int x : {0, 80, 159})
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(canvas.color.pixel(x, 60)[k], light * kColor[k], 2.0);
  }
}

TEST(Shade, TooMuchLightIsWhiteAndNotDark) {
  const Canvas canvas = wall(plain(200, 200, 200), 3.0, 2.0F, 2.0F);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(canvas.color.pixel(80, 60)[k], 255);
}

TEST(Shade, LightChangesLinearlyAcrossASurfaceInView) {
  const Canvas canvas = wall(plain(200, 200, 200), 3.0, 0.2F, 1.0F);
  for (const int x : {0, 40, 80, 120, 159}) {
    const double across = (x + 0.5 - kCamera.cx_px) / kCamera.fx_px / 4.0 + 0.5;
    EXPECT_NEAR(canvas.color.pixel(x, 30)[0], 200.0 * (0.2 + 0.8 * across), 2.0) << x;
  }
}

// Texels of two colours by turns: nearby each is seen, from afar their mean.
TEST(Shade, FarAwayATextureIsItsMean) {
  const Texture stripes = make_texture({2, 1, {255, 255, 255, 0, 0, 0}});
  const auto extremes = [&](float repeats) {
    const Canvas canvas = wall(stripes, 3.0, 1.0F, 1.0F, repeats);
    std::pair range{255, 0};
    for (int x = 0; x < 160; ++x) {
      range.first = std::min<int>(range.first, canvas.color.pixel(x, 60)[0]);
      range.second = std::max<int>(range.second, canvas.color.pixel(x, 60)[0]);
    }
    return range;
  };
  const auto near = extremes(4.0F), far = extremes(2000.0F);
  EXPECT_LT(near.first, 10);
  EXPECT_GT(near.second, 245);
  EXPECT_NEAR(far.first, 128, 3);
  EXPECT_NEAR(far.second, 128, 3);
}

TEST(Shade, TheSkyIsBluerAboveThanAtTheHorizon) {
  Canvas canvas = make_canvas(kCamera);
  shade(canvas, {});
  const std::uint8_t *top = canvas.color.pixel(80, 0), *horizon = canvas.color.pixel(80, 60);
  EXPECT_GT(horizon[0], top[0] + 30);
  EXPECT_GT(top[2] - top[0], horizon[2] - horizon[0]);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(canvas.color.pixel(80, 119)[k], horizon[k]) << "below it";
}

TEST(Shade, TheSkyTurnsWithTheCamera) {
  Canvas level = make_canvas(kCamera), rolled = make_canvas(kCamera);
  shade(level, {});
  shade(rolled, {.up_camera = Eigen::Vector3f::UnitX()});  // up is to the right in the image
  const std::uint8_t *left = rolled.color.pixel(0, 60), *right = rolled.color.pixel(159, 60);
  EXPECT_GT(left[0], right[0] + 30);
  EXPECT_EQ(level.color.pixel(0, 60)[0], level.color.pixel(159, 60)[0]);
}

}  // namespace
}  // namespace foretrack
