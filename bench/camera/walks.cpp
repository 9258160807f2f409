// SPDX-License-Identifier: Apache-2.0
#include "bench/camera/walks.hpp"

#include "bench/camera/scene.hpp"
#include "core/simulator/landmark_camera.hpp"

namespace foretrack {
namespace {

std::vector<Vec2> wandering(Random& random) {
  std::vector<Vec2> route = {{0.0, 0.0}};
  double heading = random.uniform(-kPi, kPi);
  for (int i = 0; i < 12; ++i) {
    heading += random.uniform(rad(50.0), rad(135.0)) * (random.chance(0.5) ? 1.0 : -1.0);
    Vec2 next = route.back() + random.uniform(1.5, 3.0) * direction_of(heading);
    if (next.norm() > 4.0) next = random.uniform(0.0, 1.0) * direction_of(heading);
    route.push_back(next);
  }
  return route;
}

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void append(PoseErrors& to, const PoseErrors& from) {
  append(to.horizontal_m, from.horizontal_m);
  append(to.horizontal_filtered_m, from.horizontal_filtered_m);
  append(to.range_m, from.range_m);
  append(to.yaw_rad, from.yaw_rad);
  append(to.yaw_filtered_rad, from.yaw_filtered_rad);
}

}  // namespace

void WalkScores::add(const WalkScores& other) {
  append(by_height, other.by_height);
  append(by_depth, other.by_depth);
  in_view += other.in_view;
  detected += other.detected;
  partly += other.partly;
  detected_partly += other.detected_partly;
  hidden += other.hidden;
  false_poses += other.false_poses;
  appearances += other.appearances;
  append(found_again_s, other.found_again_s);
  network_ms += other.network_ms;
  render_ms += other.render_ms;
  frames += other.frames;
}

void run_walk(const WalkCase& walk, PoseNetwork& network, const PerceptionParams& params,
              WalkScores& scores) {
  Random random(walk.seed);
  World world = square_of_houses(random);
  const auto route = wandering(random);
  Scene scene(walk, network, params, scores, std::move(world), route);
  const double eye_m = random.uniform(1.2, 2.0), bearing = random.uniform(-kPi, kPi);
  const double round_rad_s = random.uniform(-0.15, 0.15);
  scene.run([&](const PersonState& person) {
    const double t = person.stamp_s, around = bearing + round_rad_s * t;
    const Vec2 p = person.position_enu_m.head<2>() - walk.distance_m * direction_of(around);
    // A camera in flight: off the person, rolled and pitched a little.
    scene.look_from({p.x(), p.y(), eye_m}, around + rad(12.0) * std::sin(0.9 * t),
                    rad(6.0) * std::sin(1.7 * t), rad(5.0) * std::sin(1.3 * t + 1.0));
    const PoseResult result = scene.see();
    const auto view = scene.view();
    if (view == Scene::View::kNone) return;
    const bool whole = view == Scene::View::kWhole;
    ++(whole ? scores.in_view : scores.partly);
    if (!result.found()) return;
    ++(whole ? scores.detected : scores.detected_partly);
    scene.measure(result);
  });
}

void run_hidden_walk(const WalkCase& walk, PoseNetwork& network, const PerceptionParams& params,
                     WalkScores& scores) {
  Random random(walk.seed);
  World world = square_of_houses(random);
  const double half_m = random.uniform(0.9, 1.6), wall_m = walk.distance_m - 0.8;
  world.boxes.push_back({{wall_m - 0.1, -half_m, 0.0}, {wall_m + 0.1, half_m, 3.0}});
  const double reach_m = half_m * walk.distance_m / wall_m + 0.9;
  std::vector<Vec2> route;
  for (int i = 0; i < 8; ++i) route.emplace_back(walk.distance_m, (i % 2 ? 1.0 : -1.0) * reach_m);
  Scene scene(walk, network, params, scores, std::move(world), route);
  double appeared_s = -1.0;
  bool was_hidden = false;
  scene.run([&](const PersonState& person) {
    scene.look_from({0.0, 0.0, 1.5}, 0.0, 0.0, 0.0);
    const PoseResult result = scene.see();
    int points = 0;
    for (const Vec3& p : body_points_enu_m(person, walk.height_m))
      points += line_of_sight(scene.world, scene.vehicle.position_enu_m, p);
    int joints = 0;
    for (const Vec3& p : joints_enu_m(person, walk.height_m))
      joints += line_of_sight(scene.world, scene.vehicle.position_enu_m, p);
    if (joints == 0) {
      ++scores.hidden;
      scores.false_poses += result.found();
    }
    if (joints == 0) was_hidden = true, appeared_s = -1.0;
    if (was_hidden && points == 5 && appeared_s < 0.0) {
      appeared_s = person.stamp_s;
      ++scores.appearances;
    }
    if (was_hidden && appeared_s >= 0.0 && result.found()) {
      scores.found_again_s.push_back(person.stamp_s - appeared_s);
      was_hidden = false;
    }
  });
}

}  // namespace foretrack
