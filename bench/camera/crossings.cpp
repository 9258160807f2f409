// SPDX-License-Identifier: Apache-2.0
#include "bench/camera/crossings.hpp"

#include "bench/camera/scene.hpp"
#include "services/offline/people/load_person.hpp"

namespace foretrack {
namespace {

constexpr double kSpeed_m_s = 1.3, kStart_s = 0.5, kHeld_s = 0.5, kAlone_s = 0.4, kSaid_s = 1.0;

struct Routes {
  std::vector<Vec2> person, other;
  double other_speed_m_s = kSpeed_m_s;
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

Person walker(double height_m, double start_s, const std::vector<Vec2>& route, double speed_m_s) {
  return make_person({.height_m = height_m, .start_s = start_s, .stops = {}, .backward = {}},
                     walk_along(route, {.speed_m_s = speed_m_s}), 0.0);
}

// Bodies do not go through each other.
bool keep_apart(Person a, Person b, double seconds) {
  constexpr double kStep_s = 0.05, kLeast_m = 0.5;
  for (; a.state.stamp_s < seconds; advance(a, kStep_s), advance(b, kStep_s))
    if (distance_xy(a.state.position_enu_m, b.state.position_enu_m) < kLeast_m) return false;
  return true;
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
  bool is_other(const TargetState& track) const {
    return distance_xy(track.position_enu_m, other.state.position_enu_m) <
           distance_xy(track.position_enu_m, scene.person.state.position_enu_m);
  }
  bool is_near() const {
    const Vec2 apart = (other.state.position_enu_m - scene.person.state.position_enu_m).head<2>();
    const Vec2 sight =
        (scene.person.state.position_enu_m - scene.vehicle.position_enu_m).head<2>().normalized();
    return std::abs(apart.x() * sight.y() - apart.y() * sight.x()) < 1.0 && apart.norm() < 2.0;
  }
};

// Something that goes on for kHeld_s, or at the end; when it began.
struct Lasting {
  double since_s = -1.0, began_s = -1.0;

  void note(double now_s, bool is_so) {
    if (!is_so) since_s = -1.0;
    if (is_so && since_s < 0.0) since_s = now_s;
    if (is_so && now_s - since_s >= kHeld_s) end();
  }
  void end() {
    if (began_s < 0.0) began_s = since_s;
  }
  bool happened() const { return began_s >= 0.0; }
};

}  // namespace

void CrossingScores::add(const CrossingScores& o) {
  encounters += o.encounters;
  switches += o.switches;
  said += o.said;
  astray += o.astray;
  network_ms += o.network_ms;
  frames += o.frames;
  found += o.found;
  refused += o.refused;
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
  const double other_m = random.uniform(1.6, 1.9);
  Routes routes;
  Person own_walk, other_walk;
  do {
    routes = routes_of(crossing, sight, 0.5 * walk.seconds, random);
    own_walk = walker(walk.height_m, kStart_s, routes.person, kSpeed_m_s);
    other_walk = walker(other_m, kStart_s, routes.other, routes.other_speed_m_s);
  } while (!keep_apart(own_walk, other_walk, walk.seconds));
  WalkScores unused;
  Scene scene(walk, network, params, unused, std::move(world), routes.person);
  scene.person = own_walk;
  const auto people = person_names();
  const auto own = std::find(people.begin(), people.end(), walk.person) - people.begin();
  const auto beside = (own + random.integer(1, 3)) % static_cast<std::ptrdiff_t>(people.size());
  scene.camera.bystanders.push_back(
      {load_person(people[static_cast<std::size_t>(beside)]), other_walk});
  const Judge judge{scene, scene.camera.bystanders.front().person};
  const double judged_z_m = scene.camera.bystanders.front().person.state.position_enu_m.z();
  double found_s = -1.0, ambiguous_s = -1e9;
  Lasting astray, taken;
  scene.run([&](const PersonState& person) {
    const Vec2 p = person.position_enu_m.head<2>() - walk.distance_m * sight;
    const double t = person.stamp_s;
    scene.look_from({p.x(), p.y(), eye_m}, bearing + rad(5.0) * std::sin(0.9 * t),
                    rad(4.0) * std::sin(1.7 * t), rad(4.0) * std::sin(1.3 * t));
    // Chosen is who is alone at first: the other one is far below the ground for a moment.
    PersonState& apart = scene.camera.bystanders.front().person.state;
    apart.position_enu_m.z() = judged_z_m - (t < kAlone_s ? 1000.0 : 0.0);
    const PoseResult result = scene.see();
    ++scores.frames;
    scores.near_frames += judge.is_near();
    scores.ambiguous += result.ambiguous;
    if (result.ambiguous) ambiguous_s = t;
    if (result.found()) {
      const bool refused = scene.measure(result).status == PerceptionStatus::kGated;
      ++scores.found;
      scores.refused += refused;
      scores.of_other += !refused && judge.is_other(result.person);
    }
    const TargetState track = coast(scene.filter, t, scene.params);
    if (!track.usable()) return;
    found_s = t;
    const bool other = judge.is_other(track);
    astray.note(t, other);
    taken.note(t, other && track.status == TrackStatus::kTracking);
  });
  astray.end();
  taken.end();
  ++scores.encounters;
  scores.astray += astray.happened();
  scores.switches += taken.happened();
  scores.said += taken.happened() && ambiguous_s > taken.began_s - kSaid_s;
  scores.lost_at_end += walk.seconds - found_s > kHeld_s;
  scores.network_ms += unused.network_ms;
}

}  // namespace foretrack
