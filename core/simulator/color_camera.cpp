// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/color_camera.hpp"

#include <stdexcept>

#include "core/simulator/shade.hpp"

namespace foretrack {
namespace {

void to_camera(const Eigen::Isometry3f& T_camera_world, std::vector<Corner>& corners) {
  for (Corner& corner : corners) corner.camera_m = T_camera_world * corner.camera_m;
}

void draw_person(ColorCamera& camera, const Eigen::Isometry3f& T_camera_world,
                 const PersonModel& model, const PersonState& person, double height_m) {
  pose_person(model, joints_enu_m(person, height_m), height_m, camera.posed);
  cast_shadow(camera.posed, person.position_enu_m.z() - torso_height_m(height_m), camera.shadow);
  to_camera(T_camera_world, camera.posed);
  to_camera(T_camera_world, camera.shadow);
  draw(camera.canvas, model, camera.posed);
  draw_shadow(camera.canvas, model, camera.shadow,
              camera.scenery.textures[static_cast<std::size_t>(Surface::kPaving)]);
}

}  // namespace

ColorCamera make_color_camera(const ColorCameraParams& params, const World& world,
                              std::shared_ptr<const PersonModel> person) {
  if (!person) throw std::invalid_argument("make_color_camera: a person to render is needed");
  ColorCamera camera{.params = params,
                     .person = std::move(person),
                     .scenery = build_scenery(world),
                     .canvas = make_canvas(params.camera),
                     .image = {},
                     .posed = {},
                     .shadow = {},
                     .bystanders = {}};
  camera.image.camera = params.camera;
  return camera;
}

void render(ColorCamera& camera, const VehicleState& vehicle, const PersonState& person,
            double height_m) {
  const Pose T_world_camera = vehicle.T_world_body() * camera.params.camera.T_body_camera;
  const Eigen::Isometry3f T_camera_world = T_world_camera.inverse().cast<float>();
  clear(camera.canvas);
  draw(camera.canvas, camera.scenery, T_camera_world);
  draw_person(camera, T_camera_world, *camera.person, person, height_m);
  for (const auto& [model, other] : camera.bystanders)
    draw_person(camera, T_camera_world, *model, other.state, other.params.height_m);
  shade(camera.canvas, {T_camera_world.linear().col(2)});
  camera.image.stamp_s = vehicle.stamp_s;
  camera.image.pixels = camera.canvas.color;
}

const ColorImage* image_color(ColorCamera& camera, const VehicleState& vehicle,
                              const PersonState& person, double height_m) {
  if (vehicle.stamp_s < camera.next_image_s - 1e-9) return nullptr;
  camera.next_image_s += 1.0 / camera.params.rate_hz;
  render(camera, vehicle, person, height_m);
  return &camera.image;
}

const DepthImage* depth_of(const ColorCamera& camera, DepthCamera& depth) {
  const double stamp_s = camera.image.stamp_s;
  if (stamp_s < depth.next_image_s - 1e-9) return nullptr;
  depth.next_image_s += 1.0 / depth.params.rate_hz;
  const CameraModel& c = camera.params.camera;
  depth.image.stamp_s = stamp_s;
  for (std::size_t i = 0; i < depth.rays.size(); ++i) {
    const Vec3& ray = depth.rays[i];
    const Vec2 px(c.fx_px * ray.x() + c.cx_px, c.fy_px * ray.y() + c.cy_px);
    float& out = depth.image.depth_m[i];
    out = 0.0F;
    if (!c.contains(px)) continue;
    const auto row = static_cast<std::size_t>(px.y());
    const float inverse =
        camera.canvas.inverse_depth[row * c.width_px + static_cast<std::size_t>(px.x())];
    out = inverse > 0.0F ? 1.0F / inverse : 1e9F;
  }
  add_noise(depth);
  return &depth.image;
}

}  // namespace foretrack
