// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/scenery.hpp"

#include <algorithm>

namespace foretrack {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr double kHedge_m = 1.6;     // lower than this, a box is a hedge
constexpr double kBeyond_m = 150.0;  // of the ground, around the bounds
constexpr int kSides = 24;
constexpr std::array kWalls = {Surface::kBrick, Surface::kPlaster, Surface::kConcrete,
                               Surface::kPlaster};

// Texture coordinates from the distances along the two sides.
Face face(const Vec3& origin, const Vec3& along, const Vec3& up, const Vec2& first_m,
          Surface surface) {
  const Vec3f normal = along.cross(up).normalized().cast<float>();
  const double tile_m = kSurfaceTile_m[static_cast<std::size_t>(surface)];
  Face result;
  result.surface = surface;
  for (int i = 0; i < 4; ++i) {
    const double a = i == 1 || i == 2, b = i >= 2;
    Corner& corner = result.corners[i];
    corner.camera_m = (origin + a * along + b * up).cast<float>();
    corner.u = static_cast<float>((first_m.x() + a * along.norm()) / tile_m);
    corner.v = static_cast<float>((first_m.y() + b * up.norm()) / tile_m);
    corner.light = daylight(normal);
  }
  return result;
}

void add_box(std::vector<Face>& faces, const Box& box, Surface walls, Surface top) {
  const Vec3 extent = box.max_m - box.min_m;
  const Vec3 dx(extent.x(), 0, 0), dy(0, extent.y(), 0), dz(0, 0, extent.z());
  const Vec3& low = box.min_m;
  faces.push_back(face(low, dx, dz, Vec2(0.0, 0.0), walls));
  faces.push_back(face(low + dx, dy, dz, Vec2(0.3, 0.0), walls));
  faces.push_back(face(low + dx + dy, -dx, dz, Vec2(0.7, 0.0), walls));
  faces.push_back(face(low + dy, -dy, dz, Vec2(0.9, 0.0), walls));
  faces.push_back(face(low + dz, dx, dy, Vec2(low.x(), low.y()), top));
}

void add_cylinder(std::vector<Face>& faces, const Cylinder& cylinder, Surface surface) {
  const Vec3 base(cylinder.center_m.x(), cylinder.center_m.y(), cylinder.base_m);
  const Vec3 up(0.0, 0.0, cylinder.height_m);
  const auto rim = [&](int side) -> Vec3 {
    const Vec2 d = cylinder.radius_m * direction_of(2.0 * kPi * side / kSides);
    return base + Vec3(d.x(), d.y(), 0.0);
  };
  const auto light_at = [](int side) {
    const Vec2 d = direction_of(2.0 * kPi * side / kSides);
    return daylight(Vec3(d.x(), d.y(), 0.0).cast<float>());
  };
  for (int i = 0; i < kSides; ++i) {
    const Vec3 side = rim(i + 1) - rim(i);
    Face& f = faces.emplace_back(face(rim(i), side, up, Vec2(i * side.norm(), 0.0), surface));
    f.corners[0].light = f.corners[3].light = light_at(i);
    f.corners[1].light = f.corners[2].light = light_at(i + 1);
    // The lid, three corners wide.
    Face& lid = faces.emplace_back(
        face(base + up, rim(i) - base, rim(i + 1) - base, Vec2::Zero(), Surface::kRoof));
    lid.corners[1].camera_m = (rim(i) + up).cast<float>();
    lid.corners[2].camera_m = lid.corners[3].camera_m = (rim(i + 1) + up).cast<float>();
  }
}

}  // namespace

Vec3f sun_direction() {
  return Vec3f(0.35F, -0.5F, 0.8F).normalized();
}

float daylight(const Vec3f& normal_enu) {
  const float sky = 0.62F + 0.1F * normal_enu.z();
  return sky + 0.5F * std::max(0.0F, normal_enu.dot(sun_direction()));
}

Scenery build_scenery(const World& world) {
  Scenery scenery;
  for (int i = 0; i < kSurfaceCount; ++i)
    scenery.textures[i] = make_surface_texture(static_cast<Surface>(i));
  const Vec3 extent = world.max_m - world.min_m + Vec3(2.0 * kBeyond_m, 2.0 * kBeyond_m, 0.0);
  // Its texture begins at the world's origin, as that of shadows does.
  const Vec3 corner = world.min_m - Vec3(kBeyond_m, kBeyond_m, 0.0);
  scenery.faces.push_back(face(corner, Vec3(extent.x(), 0, 0), Vec3(0, extent.y(), 0),
                               corner.head<2>(), Surface::kPaving));
  std::size_t count = 0;
  for (const Box& box : world.boxes) {
    const bool hedge = box.max_m.z() - world.min_m.z() < kHedge_m;
    if (hedge)
      add_box(scenery.faces, box, Surface::kLeaves, Surface::kLeaves);
    else
      add_box(scenery.faces, box, kWalls[count++ % kWalls.size()], Surface::kRoof);
  }
  for (const Cylinder& cylinder : world.cylinders)
    add_cylinder(scenery.faces, cylinder, Surface::kConcrete);
  return scenery;
}

void draw(Canvas& canvas, const Scenery& scenery, const Eigen::Isometry3f& T_camera_world) {
  for (const Face& f : scenery.faces) {
    std::array<Corner, 4> corners = f.corners;
    for (Corner& corner : corners) corner.camera_m = T_camera_world * corner.camera_m;
    draw(canvas, corners, scenery.textures[static_cast<std::size_t>(f.surface)]);
  }
}

}  // namespace foretrack
