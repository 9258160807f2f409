#include "bench/camera/walks.hpp"

#include "core/perception/expected_place.hpp"
#include "core/perception/torso_depth.hpp"
#include "core/simulator/color_camera.hpp"
#include "core/simulator/landmark_camera.hpp"
#include "services/people/load_person.hpp"
#include "services/share/cpu_time.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kFrame_s = 1.0 / 30.0;

// Houses all around, so that the person is before walls, sky and edges.
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

// One person, one camera, one perception.
struct Scene {
  const WalkCase& walk;
  PoseNetwork& network;
  PerceptionParams params;
  WalkScores& scores;
  World world;
  Person person;
  ColorCamera camera;
  DepthCamera depth;
  PoseState eye{};
  PerceptionState filter{}, filter_with_depth{};
  VehicleHistory vehicles{};
  VehicleState vehicle{};

  Scene(const WalkCase& w, PoseNetwork& n, const PerceptionParams& p, WalkScores& s, World where,
        const std::vector<Vec2>& route)
      : walk(w),
        network(n),
        params(p),
        scores(s),
        world(std::move(where)),
        person(make_person({.height_m = w.height_m, .start_s = 0.3, .stops = {}},
                           walk_along(route, {1.4, 3.0, 0.45}), 0.0)),
        camera(make_color_camera({}, world, load_person(w.person))),
        depth(make_depth_camera({}, w.seed)) {
    params.target_height_m = w.height_m;
  }

  void look_from(const Vec3& eye_m, double yaw_rad, double roll_rad, double pitch_rad) {
    vehicle.stamp_s = person.state.stamp_s;
    vehicle.position_enu_m = eye_m;
    vehicle.q_world_body = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()) *
                           Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
                           Eigen::AngleAxisd(roll_rad, Vec3::UnitX());
    vehicles.add(vehicle);
  }

  enum class View { kWhole, kPart, kNone };  // part: the head and the torso, at least
  View view() const {
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

  PoseResult see() {
    const double begin_s = cpu_s();
    render(camera, vehicle, person.state, walk.height_m);
    const double rendered_s = cpu_s();
    const PoseResult result = perceive_image(
        eye, camera.image.pixels, vehicle.stamp_s, network, params,
        expected_place(filter, vehicles, camera.params.camera, vehicle.stamp_s, params));
    scores.render_ms += 1e3 * (rendered_s - begin_s);
    scores.network_ms += 1e3 * (cpu_s() - rendered_s);
    ++scores.frames;
    return result;
  }

  void measure(const PoseResult& result) {
    const auto observation =
        to_observation(result.person, vehicle.stamp_s, camera.params.camera, params);
    note(perceive(filter, observation, vehicles, params), scores.by_height);
    depth.next_image_s = vehicle.stamp_s;
    const auto surface_m = torso_surface_depth_m(observation, *depth_of(camera, depth));
    note(perceive(filter_with_depth, observation, vehicles, params,
                  surface_m.value_or(std::nan(""))),
         scores.by_depth);
  }

  void note(const PerceptionResult& out, PoseErrors& errors) const {
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

  template <class Aim>
  void run(Aim aim) {
    double next_s = 0.0;
    while (person.state.stamp_s < walk.seconds) {
      advance(person, kStep_s);
      if (person.state.stamp_s < next_s) continue;
      next_s += kFrame_s;
      aim(person.state);
    }
  }
};

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
