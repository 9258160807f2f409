// SPDX-License-Identifier: Apache-2.0
#include "bench/camera/scene.hpp"

#include "core/perception/expected_place.hpp"
#include "core/perception/torso_depth.hpp"
#include "core/perception/watch_others.hpp"
#include "services/common/time_now.hpp"
#include "services/offline/people/load_person.hpp"

namespace foretrack {

World square_of_houses(Random& random) {
  World world;
  for (int i = 0; i < 14; ++i) {
    const Vec2 p =
        random.uniform(11.0, 17.0) * direction_of(2.0 * kPi * (i + random.uniform()) / 14);
    const Vec2 half(random.uniform(1.0, 2.5), random.uniform(1.0, 2.5));
    world.boxes.push_back({{p.x() - half.x(), p.y() - half.y(), 0.0},
                           {p.x() + half.x(), p.y() + half.y(), random.uniform(1.2, 5.0)}});
  }
  return world;
}

Scene::Scene(const WalkCase& w, PoseNetwork& n, const PerceptionParams& p, WalkScores& s,
             World where, const std::vector<Vec2>& route)
    : walk(w),
      network(n),
      params(p),
      scores(s),
      world(std::move(where)),
      person(make_person({.height_m = w.height_m, .start_s = 0.3, .stops = {}, .backward = {}},
                         walk_along(route, {1.4, 3.0, 0.45}), 0.0)),
      camera(make_color_camera({}, world, load_person(w.person))),
      depth(make_depth_camera({}, w.seed)) {
  params.target_height_m = w.height_m;
}

void Scene::look_from(const Vec3& eye_m, double yaw_rad, double roll_rad, double pitch_rad) {
  vehicle.stamp_s = person.state.stamp_s;
  vehicle.position_enu_m = eye_m;
  vehicle.q_world_body = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()) *
                         Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
                         Eigen::AngleAxisd(roll_rad, Vec3::UnitX());
  vehicles.add(vehicle);
}

Scene::View Scene::view() const {
  const Pose T = (vehicle.T_world_body() * camera.params.camera.T_body_camera).inverse();
  const auto joints = joints_enu_m(person.state, walk.height_m);
  View view = View::kWhole;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const auto px = camera.params.camera.project(T * joints[i]);
    if (px && camera.params.camera.contains(*px)) continue;
    if (i <= kRightShoulder || i == kLeftHip || i == kRightHip) return View::kNone;
    view = View::kPart;
  }
  return view;
}

PoseResult Scene::see() {
  const double begin_s = cpu_s();
  render(camera, vehicle, person.state, walk.height_m);
  const double rendered_s = cpu_s();
  const PoseResult result = perceive_image(
      eye, camera.image.pixels, vehicle.stamp_s, network, params,
      expected_place(filter, vehicles, camera.params.camera, vehicle.stamp_s, params));
  watch_others(eye, camera.image.pixels, vehicle.stamp_s, network, params);
  scores.render_ms += 1e3 * (rendered_s - begin_s);
  scores.network_ms += 1e3 * (cpu_s() - rendered_s);
  ++scores.frames;
  return result;
}

PerceptionResult Scene::measure(const PoseResult& result) {
  auto observation = to_observation(result.person, vehicle.stamp_s, camera.params.camera, params);
  observation.doubtful = result.ambiguous;
  const PerceptionResult out = perceive(filter, observation, vehicles, params);
  note(out, scores.by_height);
  depth.next_image_s = vehicle.stamp_s;
  const auto surface_m = torso_surface_depth_m(observation, *depth_of(camera, depth));
  note(perceive(filter_with_depth, observation, vehicles, params, surface_m.value_or(std::nan(""))),
       scores.by_depth);
  return out;
}

void Scene::note(const PerceptionResult& out, PoseErrors& errors) const {
  if (out.status != PerceptionStatus::kAccepted && out.status != PerceptionStatus::kStarted &&
      out.status != PerceptionStatus::kGated)
    return;
  const Vec3& truth = person.state.position_enu_m;
  const Vec2 error = (out.measured.position_enu_m - truth).head<2>();
  const Vec2 sight = (truth - vehicle.position_enu_m).head<2>().normalized();
  errors.horizontal_m.push_back(error.norm());
  errors.range_m.push_back(error.dot(sight));
  errors.horizontal_filtered_m.push_back(distance_xy(out.target.position_enu_m, truth));
  const double yaw = person.state.body_yaw_rad;
  if (std::isfinite(out.measured.yaw_rad))
    errors.yaw_rad.push_back(std::abs(wrap_angle(out.measured.yaw_rad - yaw)));
  if (std::isfinite(out.target.body_yaw_rad))
    errors.yaw_filtered_rad.push_back(std::abs(wrap_angle(out.target.body_yaw_rad - yaw)));
}

}  // namespace foretrack
