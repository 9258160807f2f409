// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/depth_camera.hpp"

#include <algorithm>

#include "core/simulator/bystander.hpp"

namespace foretrack {
namespace {

constexpr double kNear_m = 0.05;

// Pixels [low, high) that a shape can be in.
struct Window {
  int x0, y0, x1, y1;
};

Window whole(const CameraModel& c) {
  return {0, 0, c.width_px, c.height_px};
}

// The image of a bounding box: of its corners, or everything if one is behind the camera. Empty if
// all are behind.
Window window_of(const CameraModel& c, const Pose& T_camera_world, const Vec3& low,
                 const Vec3& high) {
  Vec2 least(1e9, 1e9), greatest(-1e9, -1e9);
  int behind = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                      i & 4 ? high.z() : low.z());
    const Vec3 p = T_camera_world * corner;
    if (p.z() < kNear_m) {
      ++behind;
      continue;
    }
    const Vec2 px(c.fx_px * p.x() / p.z() + c.cx_px, c.fy_px * p.y() / p.z() + c.cy_px);
    least = least.cwiseMin(px);
    greatest = greatest.cwiseMax(px);
  }
  if (behind == 8) return {0, 0, 0, 0};
  if (behind > 0) return whole(c);
  const auto clamped = [](double v, int top) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(top)));
  };
  return {clamped(std::floor(least.x()) - 1.0, c.width_px),
          clamped(std::floor(least.y()) - 1.0, c.height_px),
          clamped(std::ceil(greatest.x()) + 1.0, c.width_px),
          clamped(std::ceil(greatest.y()) + 1.0, c.height_px)};
}

struct Bounds {
  Vec3 low, high;
};
Bounds bounds_of(const Box& b) {
  return {b.min_m, b.max_m};
}
Bounds bounds_of(const Cylinder& c) {
  return {{c.center_m.x() - c.radius_m, c.center_m.y() - c.radius_m, c.base_m},
          {c.center_m.x() + c.radius_m, c.center_m.y() + c.radius_m, c.base_m + c.height_m}};
}

struct Renderer {
  DepthCamera& camera;
  Mat3 r_world_camera;
  Vec3 eye_m;
  Pose T_camera_world;

  template <class Shape>
  void draw(const Shape& shape) {
    const CameraModel& c = camera.params.camera;
    const Bounds bounds = bounds_of(shape);
    const Vec3 nearest = eye_m.cwiseMax(bounds.low).cwiseMin(bounds.high);
    if ((nearest - eye_m).norm() > 2.0 * camera.params.range_max_m) return;
    const Window w = window_of(c, T_camera_world, bounds.low, bounds.high);
    for (int y = w.y0; y < w.y1; ++y)
      for (int x = w.x0; x < w.x1; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * c.width_px + x;
        // The ray's z in the optical frame is 1: the distance along it is the depth.
        const double depth = ray_distance_m(shape, eye_m, r_world_camera * camera.rays[i]);
        camera.image.depth_m[i] = std::min(camera.image.depth_m[i], static_cast<float>(depth));
      }
  }

  void draw_ground(double z_m) {
    const Vec3 down = r_world_camera.row(2);
    for (std::size_t i = 0; i < camera.rays.size(); ++i) {
      const double slope = down.dot(camera.rays[i]);
      if (slope < -1e-6)
        camera.image.depth_m[i] =
            std::min(camera.image.depth_m[i], static_cast<float>((z_m - eye_m.z()) / slope));
    }
  }
};

}  // namespace

DepthCamera make_depth_camera(const DepthCameraParams& params, std::uint64_t seed) {
  DepthCamera camera{.params = params, .random = Random(seed), .image = {}, .rays = {}};
  const CameraModel& c = params.camera;
  camera.image.camera = c;
  for (int y = 0; y < c.height_px; ++y)
    for (int x = 0; x < c.width_px; ++x)
      camera.rays.push_back({(x + 0.5 - c.cx_px) / c.fx_px, (y + 0.5 - c.cy_px) / c.fy_px, 1.0});
  camera.image.depth_m.resize(camera.rays.size());
  return camera;
}

void add_noise(DepthCamera& camera) {
  const DepthCameraParams& p = camera.params;
  for (float& depth : camera.image.depth_m) {
    if (!(depth > 0.0F)) continue;
    if (p.dropout > 0.0 && camera.random.chance(p.dropout)) {
      depth = 0.0F;
      continue;
    }
    if (depth > p.range_max_m) {
      depth = static_cast<float>(2.0 * p.range_max_m);
      continue;
    }
    if (p.noise_m <= 0.0) continue;
    const double far = std::max(1.0, depth / 4.0);
    depth += static_cast<float>(p.noise_m * far * far * camera.random.normal());
    depth = std::max(depth, static_cast<float>(kNear_m));
  }
}

void render(DepthCamera& camera, const World& world, const VehicleState& vehicle,
            const PersonState& person, double height_m) {
  const Pose T_world_camera = vehicle.T_world_body() * camera.params.camera.T_body_camera;
  Renderer renderer{camera, T_world_camera.linear(), T_world_camera.translation(),
                    T_world_camera.inverse()};
  camera.image.stamp_s = vehicle.stamp_s;
  std::fill(camera.image.depth_m.begin(), camera.image.depth_m.end(), 1e9F);
  renderer.draw_ground(world.min_m.z());
  for (const auto& box : world.boxes) renderer.draw(box);
  for (const auto& cylinder : world.cylinders) renderer.draw(cylinder);
  renderer.draw(cylinder_of(person, height_m));
  add_noise(camera);
}

const DepthImage* image_depth(DepthCamera& camera, const World& world, const VehicleState& vehicle,
                              const PersonState& person, double height_m) {
  if (vehicle.stamp_s < camera.next_image_s - 1e-9) return nullptr;
  camera.next_image_s += 1.0 / camera.params.rate_hz;
  render(camera, world, vehicle, person, height_m);
  return &camera.image;
}

}  // namespace foretrack
