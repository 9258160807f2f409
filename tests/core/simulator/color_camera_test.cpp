// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/color_camera.hpp"

#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"
#include "tests/support/mannequin.hpp"

namespace foretrack {
namespace {

using testing::walking;

VehicleState hovering() {
  VehicleState vehicle;
  vehicle.position_enu_m = {0.0, 0.0, 1.5};
  return vehicle;
}

Scenario filmed() {
  Scenario s;
  s.target.route_m = {{0, 0}, {8, 0}};
  s.vehicle_enu_m = Vec3(-3.0, 0.0, 1.5);
  s.color_images = true;
  s.depth_images = true;
  return s;
}

TEST(ColorCamera, ShowsThePersonWhereTheJointsProject) {
  const auto mannequin = testing::make_mannequin();
  ColorCamera camera = make_color_camera({}, {}, mannequin);
  for (const double yaw : {0.0, 1.3, kPi, -2.0}) {
    const PersonState person = walking(yaw, 0.8);
    render(camera, hovering(), person, 1.7);
    const auto joints = joints_enu_m(person, 1.7);
    const Pose T = (hovering().T_world_body() * camera.params.camera.T_body_camera).inverse();
    const std::pair<int, int> middles[] = {{11, 11}, {12, 12}, {23, 23}, {24, 24},
                                           {23, 25}, {24, 26}, {25, 27}, {26, 28}};
    for (const auto& [from, to] : middles) {
      const Vec3 p = T * (0.5 * (joints[from] + joints[to]));
      const Vec2 px = *camera.params.camera.project(p);
      const std::uint8_t* rgb =
          camera.image.pixels.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
      EXPECT_GT(rgb[0], 2 * rgb[1]) << from << " to " << to << ", yaw " << yaw;  // it is red
      const auto at = static_cast<std::size_t>(px.y()) * 640 + static_cast<std::size_t>(px.x());
      EXPECT_LT(1.0 / camera.canvas.inverse_depth[at], p.z() + 0.1);
      EXPECT_GT(1.0 / camera.canvas.inverse_depth[at], p.z() - 0.6);
    }
  }
}

TEST(ColorCamera, AWallHidesThePerson) {
  World world;
  world.boxes = {{{1.4, -3, 0}, {1.6, 3, 4}}};
  ColorCamera camera = make_color_camera({}, world, testing::make_mannequin());
  render(camera, hovering(), walking(0.0, 0.0), 1.7);
  for (int y = 0; y < 480; y += 3)
    for (int x = 150; x < 490; x += 3) {
      const std::uint8_t* rgb = camera.image.pixels.pixel(x, y);
      EXPECT_FALSE(rgb[0] > 150 && rgb[1] < 60) << x << ' ' << y;
    }
}

TEST(ColorCamera, GivesTheDepthsOfTheSamePass) {
  ColorCamera camera = make_color_camera({}, {}, testing::make_mannequin());
  DepthCameraParams params;
  params.noise_m = 0.0;
  DepthCamera depth = make_depth_camera(params, 1);
  render(camera, hovering(), walking(0.0, 0.0), 1.7);
  const DepthImage* image = depth_of(camera, depth);
  ASSERT_NE(image, nullptr);
  for (int y = 0; y < 120; y += 7)
    for (int x = 0; x < 160; x += 7) {
      const float inverse = camera.canvas.inverse_depth[(4UL * y + 2) * 640 + 4 * x + 2];
      const float expected = inverse > 0.125F ? 1.0F / inverse : 16.0F;
      EXPECT_FLOAT_EQ(image->depth_m[static_cast<std::size_t>(y) * 160 + x], expected);
    }
  EXPECT_EQ(depth_of(camera, depth), nullptr) << "the next one is not due";
}

TEST(ColorCamera, ReplacesLandmarksAndKeepsItsRate) {
  SimulatorState state = make_simulator(filmed(), testing::make_mannequin());
  int images = 0, depths = 0;
  for (int i = 0; i < 50; ++i) {
    const SimulatorOutput& out = simulate(state, {}, 0.01);
    EXPECT_FALSE(out.observation);
    images += out.color != nullptr;
    depths += out.depth != nullptr;
    if (out.color) {
      EXPECT_EQ(out.color->stamp_s, out.now_s);
      EXPECT_EQ(out.color->pixels.rgb.size(), 640U * 480U * 3U);
    }
  }
  EXPECT_NEAR(images, 15, 1);
  EXPECT_NEAR(depths, 8, 1);
}

TEST(ColorCamera, TheSameFlightGivesTheSameImages) {
  SimulatorState a = make_simulator(filmed(), testing::make_mannequin());
  SimulatorState b = make_simulator(filmed(), testing::make_mannequin());
  for (int i = 0; i < 8; ++i) {
    const auto& x = simulate(a, {}, 0.01);
    const auto& y = simulate(b, {}, 0.01);
    ASSERT_EQ(x.color != nullptr, y.color != nullptr);
    if (x.color) {
      EXPECT_EQ(x.color->pixels.rgb, y.color->pixels.rgb);
      EXPECT_EQ(a.color_camera->canvas.inverse_depth, b.color_camera->canvas.inverse_depth);
    }
  }
}

TEST(ColorCamera, NeedsSomebodyToRender) {
  EXPECT_THROW(make_simulator(filmed()), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
