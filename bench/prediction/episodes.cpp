// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/episodes.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "bench/prediction/passages.hpp"
#include "bench/prediction/turn_backs.hpp"
#include "core/common/random.hpp"
#include "core/perception/target_filter.hpp"
#include "core/simulator/person.hpp"
#include "core/simulator/route.hpp"
#include "core/simulator/track.hpp"

namespace foretrack::bench {
namespace {

constexpr double kHeight_m = 1.2;
constexpr double kMapResolution_m = 0.15;

// Errors of a camera's torso measurement: a slow part (the vehicle's own pose, the range), a white
// part, and the shoulders' angle.
class Tracker {
 public:
  Tracker(std::uint64_t seed, double flip_share)
      : random_(seed),
        flips_(seed + 77),
        flip_share_(flip_share),
        slow_sigma_m_(random_.uniform(0.03, 0.08)) {
    slow_m_ = slow_sigma_m_ * Vec2(random_.normal(), random_.normal());
  }

  /// Takes a measurement, and says what is believed of the time when it comes.
  TargetState see(double stamp_s, const Vec2& position_m, double body_yaw_rad, double now_s) {
    const double keep = std::exp(-kTruthStep_s * kTruthPerEstimate / kSlow_s);
    slow_m_ = keep * slow_m_ + std::sqrt(1.0 - keep * keep) * slow_sigma_m_ *
                                   Vec2(random_.normal(), random_.normal());
    const Vec2 seen = position_m + slow_m_ + kWhite_m * Vec2(random_.normal(), random_.normal());
    TorsoMeasurement m;
    m.stamp_s = stamp_s;
    m.position_enu_m << seen, kHeight_m;
    m.covariance_m2 = Mat3::Identity() * kWhite_m * kWhite_m * 2.0;
    draw_flip(stamp_s);
    m.yaw_rad = wrap_angle(body_yaw_rad + random_.normal(0.0, params_.yaw_noise_rad) +
                           (flipped_ ? kPi : 0.0));
    m.yaw_variance_rad2 = params_.yaw_noise_rad * params_.yaw_noise_rad;
    estimate_ = advance(estimate_, m, params_);
    TargetState state = target_state(predict_estimate(estimate_, now_s, params_));
    state.status = TrackStatus::kTracking;
    return state;
  }

 private:
  static constexpr double kSlow_s = 0.5;
  static constexpr double kFlipSpell_s = 0.5;

  void draw_flip(double stamp_s) {
    if (stamp_s < flips_until_s_) return;
    flips_until_s_ = stamp_s + kFlipSpell_s;
    flipped_ = flips_.chance(flip_share_);
  }

  static constexpr double kWhite_m = 0.03;

  PerceptionParams params_;
  Random random_, flips_;
  double flip_share_, flips_until_s_ = -1.0;
  bool flipped_ = false;
  double slow_sigma_m_;
  Vec2 slow_m_;
  TargetEstimate estimate_;
};

// The world cut down to a slice at the torso's height: prediction reads no more.
Passages place_of(const SimulatedWalk& walk) {
  constexpr std::ptrdiff_t kLastNodes = 5;
  Passages place;
  if (walk.in_passages) {
    place = generate_passages(walk.seed);
    if (walk.returns_at_end)
      place.route_m.erase(place.route_m.begin(), place.route_m.end() - kLastNodes);
  } else {
    const RouteRequest request{.seed = walk.seed, .length_m = walk.speed_m_s * walk.duration_s};
    place.world = generate_world({.kind = walk.kind, .seed = walk.seed});
    place.route_m = walk.kind == WorldKind::kTIntersection ? t_intersection_route(request)
                                                           : generate_route(place.world, request);
  }
  place.world.min_m.z() = kHeight_m - 2.0 * kMapResolution_m;
  place.world.max_m.z() = kHeight_m + 2.0 * kMapResolution_m;
  return place;
}

// Nobody knows a stranger's: 0.3 s, more or less.
double shoulder_lead_s(Random& random) {
  return random.uniform(0.2, 0.4);
}

PersonParams person_params(const SimulatedWalk& walk, Random& random) {
  PersonParams params;
  params.start_s = random.uniform(0.5, 3.0);
  params.shoulder_lead_s = shoulder_lead_s(random);
  if (walk.chest.lead_s) params.shoulder_lead_s = *walk.chest.lead_s;
  params.shoulder_offset_rad = walk.chest.offset_rad;
  params.shoulder_sway_rad = walk.chest.sway_rad;
  params.shoulder_sway_hz = walk.chest.sway_hz;
  for (int i = 0; i < walk.stops; ++i)
    params.stops.push_back(
        {(i + random.uniform(0.3, 0.8)) * walk.duration_s / walk.stops, random.uniform(1.0, 3.0)});
  return params;
}

// Along the route, with turns back if that is asked for.
ReturningWalk way_of(const SimulatedWalk& walk, const std::vector<Vec2>& route_m, Random& random) {
  if (!walk.returns_at_end && walk.return_every_m <= 0.0)
    return {walk_along(route_m, {.speed_m_s = walk.speed_m_s}), {}};
  return walk_and_return(
      route_m, {walk.speed_m_s, walk.duration_s, walk.return_every_m, walk.returns_at_end}, random);
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// Images come late, some cameras' more than others'.
int steps_of_delay(std::uint64_t seed) {
  constexpr double kLongest_s = 0.1;
  Random random(seed + 99);
  return static_cast<int>(std::lround(random.uniform(0.0, kLongest_s) / kTruthStep_s));
}

// Notes the person's walk and what a tracker sees of it.
void walk_and_watch(Person person, std::uint64_t seed, double flip_share, double longest_s,
                    Episode& episode) {
  Tracker tracker(seed, flip_share);
  const int count = static_cast<int>(std::min(longest_s, person.walk.duration_s()) / kTruthStep_s);
  const int late = steps_of_delay(seed);
  std::vector<double> body_yaw_rad;
  for (int i = 0; i < count; ++i) {
    const PersonState& s = person.state;
    episode.truth.samples.push_back({s.position_enu_m.head<2>(), s.velocity_enu_m_s.head<2>()});
    body_yaw_rad.push_back(s.body_yaw_rad);
    if (i % kTruthPerEstimate == 0) {
      const int seen = std::max(0, i - late);
      episode.estimates.push_back(tracker.see(seen * kTruthStep_s,
                                              episode.truth.samples[seen].position_m,
                                              body_yaw_rad[seen], i * kTruthStep_s));
    }
    advance(person, kTruthStep_s);
  }
}

// Nothing but ground for 10 m around a track.
World free_world(const Track& track) {
  World world;
  const auto bounds = bounds_of(track.points);
  world.min_m << bounds.min() - Vec2::Constant(10.0), kHeight_m - 2.0 * kMapResolution_m;
  world.max_m << bounds.max() + Vec2::Constant(10.0), kHeight_m + 2.0 * kMapResolution_m;
  return world;
}

Episode replay(const Track& track, std::uint64_t seed) {
  Episode episode;
  episode.name = "recorded";
  episode.map = known_map(free_world(track), kMapResolution_m);
  PersonParams params;
  params.start_s = 0.0;
  Random random(seed);
  params.shoulder_lead_s = shoulder_lead_s(random);
  walk_and_watch(make_person(params, walk_through(track.points), 0.0), seed, 0.0, 1e9, episode);
  return episode;
}

}  // namespace

Episode simulate_walk(const SimulatedWalk& walk) {
  Episode episode;
  episode.name = walk.in_passages ? "passages" : kWorldKindNames[static_cast<int>(walk.kind)];
  const Passages place = place_of(walk);
  episode.map = known_map(place.world, kMapResolution_m);
  Random random(walk.seed);
  PersonParams person = person_params(walk, random);
  ReturningWalk way = way_of(walk, place.route_m, random);
  person.backward = std::move(way.backward);
  walk_and_watch(make_person(person, std::move(way.walk), 0.0), walk.seed, walk.chest.flip_share,
                 walk.duration_s, episode);
  return episode;
}

Episode without_map(Episode episode) {
  episode.map = {};
  return episode;
}

Episode without_body(Episode episode) {
  for (TargetState& s : episode.estimates)
    s.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  return episode;
}

std::vector<SimulatedWalk> turning_walks(std::uint64_t first_seed, int rounds) {
  std::vector<SimulatedWalk> walks;
  std::uint64_t seed = first_seed;
  for (int round = 0; round < rounds; ++round)
    for (const double speed : {1.0, 1.5, 2.0}) {
      for (int i = 0; i < 6; ++i)
        walks.push_back({true, WorldKind::kEmpty, seed++, speed, round % 2});
      for (int kind = 0; kind < static_cast<int>(kWorldKindNames.size()); ++kind)
        walks.push_back({false, static_cast<WorldKind>(kind), seed++, speed, round % 2});
    }
  return walks;
}

std::vector<SimulatedWalk> stopping_walks(std::uint64_t first_seed, int rounds) {
  std::vector<SimulatedWalk> walks;
  std::uint64_t seed = first_seed;
  for (int round = 0; round < rounds; ++round)
    for (const double speed : {1.0, 1.5, 2.0})
      for (const int stops : {3, 6, 10})
        walks.push_back({false, WorldKind::kWalls, seed++, speed, stops});
  return walks;
}

std::vector<SimulatedWalk> returning_walks(std::uint64_t first_seed, int rounds) {
  std::vector<SimulatedWalk> walks;
  std::uint64_t seed = first_seed;
  for (int round = 0; round < rounds; ++round)
    for (const double speed : {1.0, 1.5, 2.0}) {
      for (const double every_m : {12.0, 30.0})
        for (const bool in_passages : {true, false})
          walks.push_back({in_passages, WorldKind::kWalls, seed++, speed, 0, every_m});
      walks.push_back({true, WorldKind::kWalls, seed++, speed, 0, 0.0, true});
    }
  return walks;
}

std::vector<RecordedWalk> recorded_walks(const std::string& path, int rounds) {
  constexpr double kFrames_hz = 25.0, kShortest_s = 3.0;
  const std::string text = text_of_file(path);
  std::vector<RecordedWalk> walks;
  if (text.empty()) return walks;
  for (const Track& track : parse_tracks(text, TrackFormat::kOpenTraj, kFrames_hz, path)) {
    if (track.points.size() < 4) continue;
    if (track.points.back().time_s - track.points.front().time_s < kShortest_s) continue;
    const auto seed = static_cast<std::uint64_t>(1000 * track.pedestrian);
    for (int round = 1; round <= rounds; ++round)
      walks.push_back({track.pedestrian, replay(track, seed + round)});
  }
  return walks;
}

}  // namespace foretrack::bench
