// SPDX-License-Identifier: Apache-2.0
// Random optimisation problems that look like tracking: a target that walks and may turn, a vehicle
// some way behind it, boxes around the way there. Shared by the tests and the benchmark.
#pragma once

#include <vector>

#include "core/common/random.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"

namespace foretrack {

struct RandomProblemOptions {
  int polytopes_min = 4, polytopes_max = 6;
  int paths = 1;  // intention paths: the first goes where the vehicle's guess follows
  int samples_per_path = 15;
  double sample_step_s = 0.2;
  double behind_m = 2.0;  // of the vehicle, on the target's way
  bool bodies = false;    // somebody crosses the way
};

namespace random_problem {

struct Walk {
  double speed_m_s, turn_at_s, turn_rad;
  Vec3 at(double t) const {
    const double before = std::min(t, turn_at_s), after = std::max(t - turn_at_s, 0.0);
    return {speed_m_s * (before + after * std::cos(turn_rad)),
            speed_m_s * after * std::sin(turn_rad), 1.0};
  }
};

/// A box around the segment, some of its corners cut off by random planes.
inline Polytope box_around(const Vec3& a, const Vec3& b, Random& random) {
  const Vec3 along = (b - a).norm() > 1e-6 ? Vec3((b - a).normalized()) : Vec3(Vec3::UnitX());
  const Vec3 side = Vec3::UnitZ().cross(along).normalized(), up = along.cross(side);
  Polytope box;
  const auto add = [&](const Vec3& normal, double margin_m) {
    const double offset = std::max(normal.dot(a), normal.dot(b)) + margin_m;
    box.planes.emplace_back(normal.x(), normal.y(), normal.z(), offset);
  };
  for (const double sign : {-1.0, 1.0}) {
    add(sign * along, random.uniform(0.3, 0.8));
    add(sign * side, random.uniform(0.25, 1.2));
    add(sign * up, random.uniform(0.3, 0.8));
  }
  const int cuts = random.integer(2, 10);
  for (int i = 0; i < cuts; ++i) {
    const Vec3 normal(random.normal(), random.normal(), 0.5 * random.normal());
    add(normal.normalized(), random.uniform(0.3, 1.2));
  }
  return box;
}

inline void add_samples(const Walk& walk, double weight, double beyond_s,
                        const RandomProblemOptions& options, Random& random,
                        OptimizationProblem& problem) {
  const double opening_rad = random.uniform(0.4, 1.3);
  for (int k = 1; k <= options.samples_per_path; ++k) {
    const auto bearing = [&](double t) {
      return yaw_of(Vec2((walk.at(t - beyond_s) - walk.at(t)).head<2>()));
    };
    TargetSample s;
    s.time_s = k * options.sample_step_s;
    s.weight = weight * (1.0 - 0.3 * k / options.samples_per_path);
    s.target_enu_m = walk.at(s.time_s);
    s.has_region = true;
    s.bisector_rad = bearing(s.time_s) + random.normal(0.0, 0.1);
    s.half_angle_rad = opening_rad;
    s.has_next = k < options.samples_per_path;
    s.next_target_enu_m = walk.at(s.time_s + options.sample_step_s);
    s.next_bisector_rad = bearing(s.time_s + options.sample_step_s);
    s.next_half_angle_rad = opening_rad + 0.2;
    problem.samples.push_back(s);
  }
}

}  // namespace random_problem

inline OptimizationProblem make_random_problem(std::uint64_t seed,
                                               const RandomProblemOptions& options = {}) {
  Random random(seed);
  OptimizationProblem problem;
  const double horizon_s = options.samples_per_path * options.sample_step_s;
  random_problem::Walk walk{random.uniform(0.5, 2.0), random.uniform(0.0, 2.5), 0.0};
  walk.turn_rad = random.chance(0.7) ? random.uniform(-1.7, 1.7) : 0.0;
  // The vehicle's guess: the target's own way, some metres late, on a coarse grid. From further
  // behind it catches up at most of its speed.
  const double view_s = 2.0 / walk.speed_m_s, behind_s = options.behind_m / walk.speed_m_s;
  const double catch_up = std::max(2.3 / walk.speed_m_s, 1.0);
  const auto guess = [&](double t) {
    Vec3 p = walk.at(std::min(catch_up * t - behind_s, t - view_s)) + Vec3(0.0, 0.0, 0.5);
    for (int i = 0; i < 3; ++i) p[i] += random.uniform(-0.1, 0.1);
    return p;
  };
  problem.start.position = guess(0.0);
  problem.start.velocity = Vec3(walk.speed_m_s + random.normal(0.0, 0.3), random.normal(0, 0.3), 0);
  problem.start.acceleration = Vec3(random.normal(), random.normal(), 0.1 * random.normal());
  problem.goal.position = guess(horizon_s);
  problem.goal.velocity = walk.at(horizon_s + 0.5) - walk.at(horizon_s - 0.5);
  const int polytopes = random.integer(options.polytopes_min, options.polytopes_max);
  const int pieces = kPiecesPerPolytope * polytopes;
  for (int i = 1; i < pieces; ++i) problem.inner_waypoints.push_back(guess(horizon_s * i / pieces));
  problem.durations_s.assign(pieces, horizon_s / pieces);
  const auto waypoint = [&](int i) {
    return i == 0 ? problem.start.position
                  : (i == pieces ? problem.goal.position : problem.inner_waypoints[i - 1]);
  };
  for (int i = 0; i < polytopes; ++i)
    problem.corridor.push_back(random_problem::box_around(
        waypoint(kPiecesPerPolytope * i), waypoint(kPiecesPerPolytope * (i + 1)), random));
  problem.min_total_duration_s = horizon_s;
  // Somebody who crosses the way.
  for (int i = 1; options.bodies && i <= 10; ++i)
    problem.bodies.push_back(
        {0.2 * i, 1.0, {guess(1.0) + Vec3(0.0, 0.3 * (i - 5), -1.5), 0.25, 1.75}});
  double left = 1.0;
  for (int path = 0; path < options.paths; ++path) {
    const double weight = path + 1 == options.paths ? left : 0.6 * left;
    left -= weight;
    random_problem::add_samples(walk, weight, view_s, options, random, problem);
    walk.turn_at_s = random.uniform(0.3, 1.5);
    walk.turn_rad = random.uniform(-1.7, 1.7);
  }
  return problem;
}

}  // namespace foretrack
