// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/rasterizer.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "core/simulator/depth_camera.hpp"
#include "core/simulator/generate_world.hpp"
#include "core/simulator/scenery.hpp"
#include "core/simulator/shade.hpp"

namespace foretrack {
namespace {

const Texture& white() {
  static const Texture texture = make_texture({1, 1, {255, 255, 255}});
  return texture;
}

Corner corner(const Vec3& p, float u = 0.0F, float v = 0.0F) {
  return {p.cast<float>(), u, v, 1.0F};
}

double depth_at(const Canvas& canvas, int x, int y) {
  return 1.0 / canvas.inverse_depth[static_cast<std::size_t>(y) * canvas.camera.width_px + x];
}

Vec3 ray(const CameraModel& c, int x, int y) {
  return {(x + 0.5 - c.cx_px) / c.fx_px, (y + 0.5 - c.cy_px) / c.fy_px, 1.0};
}

// Counter-clockwise from the camera at the origin, which looks along z with y down.
std::array<Corner, 4> square(const Vec3& center, double half_m) {
  const Vec3 x(half_m, 0, 0), y(0, half_m, 0);
  return {corner(center - x - y, 0, 1), corner(center - x + y, 0, 0), corner(center + x + y, 1, 0),
          corner(center + x - y, 1, 1)};
}

TEST(Rasterizer, PutsAPointWhereTheCameraProjectsIt) {
  Canvas canvas = make_canvas({});
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(random.uniform(-2, 2), random.uniform(-1.5, 1.5), random.uniform(2.5, 6));
    clear(canvas);
    draw(canvas, square(p, 0.5 * p.z() / 300.0), white());  // about a pixel
    const Vec2 px = *canvas.camera.project(p);
    int found = 0;
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 640; ++x) {
        if (canvas.facet[static_cast<std::size_t>(y) * 640 + x] < 0) continue;
        ++found;
        EXPECT_LT((Vec2(x + 0.5, y + 0.5) - px).cwiseAbs().maxCoeff(), 0.6);
      }
    EXPECT_GE(found, 1);
    EXPECT_LE(found, 4);
  }
}

TEST(Rasterizer, DepthOfASlantedPlaneIsThatOfItsRays) {
  Canvas canvas = make_canvas({});
  const Vec3 a(-3, 2, 2), b(3, 2.5, 3), c(4, -3, 7), d = a + (c - b);
  draw(canvas, std::array{corner(a), corner(b), corner(c), corner(d)}, white());
  const Vec3 normal = (b - a).cross(c - a);
  int seen = 0;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      if (canvas.facet[static_cast<std::size_t>(y) * 640 + x] < 0) continue;
      ++seen;
      EXPECT_NEAR(depth_at(canvas, x, y), normal.dot(a) / normal.dot(ray(canvas.camera, x, y)),
                  1e-4);
    }
  EXPECT_GT(seen, 50000);
}

TEST(Rasterizer, TheNearerSurfaceIsSeenInAnyOrder) {
  const Texture red = make_texture({1, 1, {200, 0, 0}});
  for (const bool near_first : {true, false}) {
    Canvas canvas = make_canvas({});
    if (near_first) draw(canvas, square({0, 0, 2}, 0.5), red);
    draw(canvas, square({0, 0, 4}, 3.0), white());
    if (!near_first) draw(canvas, square({0, 0, 2}, 0.5), red);
    shade(canvas, {});
    EXPECT_NEAR(depth_at(canvas, 320, 240), 2.0, 1e-5);
    EXPECT_EQ(canvas.color.pixel(320, 240)[1], 0);
    EXPECT_NEAR(depth_at(canvas, 200, 240), 4.0, 1e-5);
    EXPECT_GT(canvas.color.pixel(200, 240)[1], 200);
  }
}

TEST(Rasterizer, BacksAreNotDrawn) {
  Canvas canvas = make_canvas({});
  auto back = square({0, 0, 2}, 0.5);
  std::reverse(back.begin(), back.end());
  draw(canvas, back, white());
  EXPECT_TRUE(canvas.facets.empty());
}

TEST(Rasterizer, NeighboursLeaveNoGapBetweenThem) {
  Canvas canvas = make_canvas({});
  Random random(5);
  // A wall of 10 × 10 crooked quads in two triangles each.
  std::array<std::array<Corner, 11>, 11> grid;
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i)
      grid[j][i] = corner({i - 5 + random.uniform(-0.3, 0.3), j - 5 + random.uniform(-0.3, 0.3),
                           4 + random.uniform(-0.3, 0.3)});
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      draw(canvas, std::array{grid[j][i], grid[j + 1][i], grid[j + 1][i + 1]}, white());
      draw(canvas, std::array{grid[j][i], grid[j + 1][i + 1], grid[j][i + 1]}, white());
    }
  for (int y = 40; y < 440; ++y)
    for (int x = 40; x < 600; ++x)
      ASSERT_GE(canvas.facet[static_cast<std::size_t>(y) * 640 + x], 0) << x << ' ' << y;
}

TEST(Rasterizer, CutsOffWhatIsBehindTheCamera) {
  Canvas canvas = make_canvas({});
  const double z = 1.5;  // ground this far below, all around
  draw(canvas,
       std::array{corner({-50, z, -50}), corner({50, z, -50}), corner({50, z, 50}),
                  corner({-50, z, 50})},
       white());
  for (const int y : {250, 300, 479})
    for (const int x : {0, 320, 639})
      EXPECT_NEAR(depth_at(canvas, x, y), z / ray(canvas.camera, x, y).y(), 1e-3) << x << ' ' << y;
  EXPECT_EQ(canvas.facet[100 * 640 + 320], -1);
}

TEST(Rasterizer, TexturesLieInPerspective) {
  // The right half of the picture is blue; the plane recedes to the right.
  const Texture halves = make_texture({2, 1, {255, 0, 0, 0, 0, 255}});
  Canvas canvas = make_canvas({});
  const Vec3 a(-2, 1, 2), b(4, 1, 8), c(4, -1, 8), d(-2, -1, 2);
  draw(canvas,
       std::array{corner(a, 0.25F, 0), corner(b, 0.75F, 0), corner(c, 0.75F, 1),
                  corner(d, 0.25F, 1)},
       halves);
  shade(canvas, {});
  const auto color_at = [&](double share) {
    const Vec2 px = *canvas.camera.project(a + share * (b - a) - Vec3(0, 1, 0));
    return canvas.color.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
  };
  EXPECT_GT(color_at(0.1)[0], 200);
  EXPECT_GT(color_at(0.9)[2], 200);
  // In the middle of the plane, which is not the middle of its image, the colours are half mixed.
  EXPECT_NEAR(color_at(0.5)[0], 128, 12);
}

TEST(Rasterizer, DepthsOfAWorldAreThoseOfRayCasting) {
  for (const WorldKind kind : {WorldKind::kBoxes, WorldKind::kTIntersection, WorldKind::kHedges}) {
    const World world = generate_world({kind, 60, 4});
    DepthCameraParams params;
    params.noise_m = 0.0;
    params.range_max_m = 30.0;
    DepthCamera rays = make_depth_camera(params, 1);
    VehicleState vehicle;
    vehicle.position_enu_m = {0.2, 0.1, 1.6};
    vehicle.q_world_body = Eigen::AngleAxisd(0.7, Vec3::UnitZ()) *
                           Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                           Eigen::AngleAxisd(-0.1, Vec3::UnitX());
    PersonState nobody;
    nobody.position_enu_m = {500, 0, 1};
    render(rays, world, vehicle, nobody, 1.75);
    Canvas canvas = make_canvas(params.camera);
    const Pose T_world_camera = vehicle.T_world_body() * params.camera.T_body_camera;
    draw(canvas, build_scenery(world), T_world_camera.inverse().cast<float>());
    int differ = 0, compared = 0;
    for (std::size_t i = 0; i < rays.image.depth_m.size(); ++i) {
      if (rays.image.depth_m[i] > 30.0F) continue;
      ++compared;
      const double depth = 1.0 / canvas.inverse_depth[i];
      differ += std::abs(depth - rays.image.depth_m[i]) > 2e-3 * depth;
    }
    EXPECT_GT(compared, 5000);
    EXPECT_LE(differ, compared / 1000);  // at silhouettes, rounding decides
  }
}

}  // namespace
}  // namespace foretrack
