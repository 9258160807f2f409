#include "bench/camera/crossings.hpp"

#include "bench/camera/scene.hpp"
#include "services/people/load_person.hpp"

namespace foretrack {
namespace {

constexpr double kSpeed_m_s = 1.3, kStart_s = 0.5, kHeld_s = 0.5;

struct Routes {
  std::vector<Vec2> person, other;
  double other_speed_m_s = kSpeed_m_s, other_start_s = kStart_s;
};

// The person walks along x and is at the origin at `meet_s`, as the other one is near it. The
// camera looks along `sight`.
Routes routes_of(Crossing crossing, const Vec2& sight, double meet_s, Random& random) {
  const double until_m = kSpeed_m_s * (meet_s - kStart_s);
  const Vec2 along(1.0, 0.0), across(-sight.y(), sight.x());
  const double gap_m = random.uniform(0.55, 0.9), side = random.chance(0.5) ? 1.0 : -1.0;
  Routes r;
  r.person = {-until_m * along, 6.0 * along};
  r.other_speed_m_s = random.uniform(1.0, 1.6);
  // When the other one is at `where`, the person is at the origin.
  const auto through = [&](const Vec2& where, const Vec2& heading) {
    const double before_m = r.other_speed_m_s * (meet_s - kStart_s);
    r.other = {where - before_m * heading, where + 5.0 * heading};
  };
  switch (crossing) {
    case Crossing::kInFront:
      through(-gap_m * sight, side * across);
      break;
    case Crossing::kBehind:
      through(gap_m * sight, side * across);
      break;
    case Crossing::kBeside:
      r.other_speed_m_s = kSpeed_m_s;
      through(side * gap_m * Vec2(-along.y(), along.x()), along);
      break;
    case Crossing::kAgainst:
      through(side * gap_m * Vec2(-along.y(), along.x()), -along);
      break;
    case Crossing::kStands:
      r.other = {side * gap_m * Vec2(-along.y(), along.x())};
      break;
  }
  return r;
}

// Whose pose it is: the torso in the image, and how large the body is there.
struct Judge {
  const Scene& scene;
  const Person& other;

  double distance_to(const PersonState& who, double height_m, const PersonPose& pose) const {
    const CameraModel& camera = scene.camera.params.camera;
    const Pose T = (scene.vehicle.T_world_body() * camera.T_body_camera).inverse();
    const auto joints = joints_enu_m(who, height_m);
    double sum_px = 0.0;
    int count = 0;
    for (int k = 0; k < kLandmarkCount; ++k) {
      const Vec3 p = T * joints[k];
      const auto px = camera.project(p);
      if (!px) continue;
      sum_px += (pose.landmarks[k].image_px - *px).norm() * p.z() / camera.fx_px;  // in metres
      ++count;
    }
    return count > 0 ? sum_px / count : 1e9;
  }
  bool is_other(const PersonPose& pose) const {
    return distance_to(other.state, other.params.height_m, pose) <
           distance_to(scene.person.state, scene.walk.height_m, pose);
  }
  bool is_near() const {
    const Vec2 apart = (other.state.position_enu_m - scene.person.state.position_enu_m).head<2>();
    const Vec2 sight =
        (scene.person.state.position_enu_m - scene.vehicle.position_enu_m).head<2>().normalized();
    return std::abs(apart.x() * sight.y() - apart.y() * sight.x()) < 1.0 && apart.norm() < 2.0;
  }
};

}  // namespace

void CrossingScores::add(const CrossingScores& o) {
  encounters += o.encounters;
  switches += o.switches;
  frames += o.frames;
  found += o.found;
  of_other += o.of_other;
  ambiguous += o.ambiguous;
  near_frames += o.near_frames;
  lost_at_end += o.lost_at_end;
}

void run_crossing(const WalkCase& walk, Crossing crossing, PoseNetwork& network,
                  const PerceptionParams& params, CrossingScores& scores) {
  Random random(walk.seed);
  World world = square_of_houses(random);
  const double bearing = random.uniform(-kPi, kPi), eye_m = random.uniform(1.3, 1.8);
  const Vec2 sight = direction_of(bearing);
  const Routes routes = routes_of(crossing, sight, 0.5 * walk.seconds, random);
  WalkScores unused;
  Scene scene(walk, network, params, unused, std::move(world), routes.person);
  scene.person = make_person({.height_m = walk.height_m, .start_s = kStart_s, .stops = {}},
                             walk_along(routes.person, {.speed_m_s = kSpeed_m_s}), 0.0);
  const auto people = person_names();
  const auto own = std::find(people.begin(), people.end(), walk.person) - people.begin();
  const auto beside = (own + random.integer(1, 3)) % static_cast<std::ptrdiff_t>(people.size());
  scene.camera.bystanders.push_back(
      {load_person(people[static_cast<std::size_t>(beside)]),
       make_person(
           {.height_m = random.uniform(1.6, 1.9), .start_s = routes.other_start_s, .stops = {}},
           walk_along(routes.other, {.speed_m_s = routes.other_speed_m_s}), 0.0)});
  const Judge judge{scene, scene.camera.bystanders.front().person};
  double other_since_s = -1.0, found_s = -1.0;
  bool switched = false;
  scene.run([&](const PersonState& person) {
    const Vec2 p = person.position_enu_m.head<2>() - walk.distance_m * sight;
    const double t = person.stamp_s;
    scene.look_from({p.x(), p.y(), eye_m}, bearing + rad(5.0) * std::sin(0.9 * t),
                    rad(4.0) * std::sin(1.7 * t), rad(4.0) * std::sin(1.3 * t));
    const PoseResult result = scene.see();
    ++scores.frames;
    scores.near_frames += judge.is_near();
    scores.ambiguous += result.ambiguous;
    if (!result.found()) return;
    scene.measure(result);
    ++scores.found;
    found_s = t;
    const bool other = judge.is_other(result.person);
    scores.of_other += other;
    if (!other) other_since_s = -1.0;
    if (other && other_since_s < 0.0) other_since_s = t;
    switched = switched || (other && t - other_since_s >= kHeld_s);
  });
  ++scores.encounters;
  scores.switches += switched || other_since_s >= 0.0;
  scores.lost_at_end += walk.seconds - found_s > kHeld_s;
}

}  // namespace foretrack
