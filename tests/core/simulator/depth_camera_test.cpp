// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/depth_camera.hpp"

#include <gtest/gtest.h>

#include "core/simulator/generate_world.hpp"

namespace foretrack {
namespace {

VehicleState vehicle_at(const Vec3& p, double yaw, double pitch = 0.0) {
  VehicleState v;
  v.position_enu_m = p;
  v.q_world_body =
      Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()));
  return v;
}

PersonState person_at(double x, double y) {
  PersonState p;
  p.position_enu_m = {x, y, torso_height_m(1.75)};
  return p;
}

TEST(DepthCamera, DepthsAreThoseOfRaysCastOneByOne) {
  World world = generate_world({WorldKind::kBoxes, 100, 3});
  const World cylinders = generate_world({WorldKind::kCylinders, 50, 5});
  world.cylinders = cylinders.cylinders;
  DepthCameraParams params;
  params.noise_m = 0.0;
  DepthCamera camera = make_depth_camera(params, 1);
  const PersonState person = person_at(0.5, -7);
  Random random(2);
  for (int view = 0; view < 10; ++view) {
    VehicleState vehicle = vehicle_at({random.uniform(-8, 8), random.uniform(-8, 8), 1.5},
                                      random.uniform(-3, 3), random.uniform(-0.4, 0.4));
    if (clearance_m(world, vehicle.position_enu_m) < 0.05) continue;
    render(camera, world, vehicle, person, 1.75);
    const Mat3 r = (vehicle.q_world_body * Quat(params.camera.T_body_camera.linear())).matrix();
    for (std::size_t i = 0; i < camera.rays.size(); i += 7) {
      const double scale = camera.rays[i].norm();
      const Vec3 direction = r * camera.rays[i] / scale;
      World with_person = world;
      double along = ray_distance_m(world, vehicle.position_enu_m, direction, 1e6);
      along = std::min(along, ray_distance_m(Cylinder{{0.5, -7}, 0.25, 1.75, 0.0},
                                             vehicle.position_enu_m, direction));
      if (direction.z() < 0) along = std::min(along, -vehicle.position_enu_m.z() / direction.z());
      double expected = along / scale;
      if (expected > params.range_max_m) expected = 2.0 * params.range_max_m;
      ASSERT_NEAR(camera.image.depth_m[i], expected, 1e-4) << view << " " << i;
    }
  }
}

TEST(DepthCamera, NoiseAndDropoutsHaveTheStatedSize) {
  World wall;
  wall.boxes.push_back({{3, -20, 0}, {3.5, 20, 20}});
  DepthCameraParams params;
  params.noise_m = 0.02;
  params.dropout = 0.1;
  DepthCamera camera = make_depth_camera(params, 4);
  render(camera, wall, vehicle_at({0, 0, 10}, 0), person_at(-5, 0), 1.75);
  double square = 0.0;
  int dropped = 0, kept = 0;
  for (const float depth : camera.image.depth_m) {
    dropped += depth == 0.0F;
    if (depth == 0.0F) continue;
    ++kept;
    square += (depth - 3.0) * (depth - 3.0);
  }
  EXPECT_NEAR(std::sqrt(square / kept), 0.02, 0.001);
  EXPECT_NEAR(dropped / 19200.0, 0.1, 0.01);
}

TEST(DepthCamera, NoiseGrowsWithTheSquareOfTheDepthBeyondFourMetres) {
  for (const auto& [depth_m, sigma_m] : {std::pair{2.0, 0.02}, {4.0, 0.02}, {7.0, 0.06125}}) {
    DepthCamera camera = make_depth_camera({.noise_m = 0.02}, 7);
    std::fill(camera.image.depth_m.begin(), camera.image.depth_m.end(),
              static_cast<float>(depth_m));
    add_noise(camera);
    double square = 0.0;
    for (const float d : camera.image.depth_m) square += (d - depth_m) * (d - depth_m);
    EXPECT_NEAR(std::sqrt(square / static_cast<double>(camera.image.depth_m.size())), sigma_m,
                0.03 * sigma_m);
  }
}

TEST(DepthCamera, BeyondItsRangeTheWayIsFreeAndNoReturnStaysNone) {
  DepthCamera camera = make_depth_camera({.range_max_m = 8.0}, 7);
  camera.image.depth_m[0] = 8.5F;
  camera.image.depth_m[1] = 1e9F;
  camera.image.depth_m[2] = 0.0F;
  add_noise(camera);
  EXPECT_EQ(camera.image.depth_m[0], 16.0F);
  EXPECT_EQ(camera.image.depth_m[1], 16.0F);
  EXPECT_EQ(camera.image.depth_m[2], 0.0F);
}

TEST(DepthCamera, TakesAsManyImagesAsItsRate) {
  DepthCamera camera = make_depth_camera({.rate_hz = 15.0}, 1);
  int images = 0;
  for (int i = 0; i < 100; ++i) {
    VehicleState vehicle = vehicle_at({0, 0, 1.5}, 0);
    vehicle.stamp_s = 0.01 * i;
    const DepthImage* image = image_depth(camera, {}, vehicle, person_at(3, 0), 1.75);
    images += image != nullptr;
    if (image) {
      EXPECT_EQ(image->stamp_s, vehicle.stamp_s);
    }
  }
  EXPECT_EQ(images, 15);
}

}  // namespace
}  // namespace foretrack
