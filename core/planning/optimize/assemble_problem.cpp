// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/assemble_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr double kHiddenCost = 1.0;      // m², of not seeing the end of a path
constexpr double kGoalShiftCost = 0.05;  // of a squared metre away from the path's end
constexpr double kGoalStep_m = 0.25;
constexpr double kBodyStep_s = 0.1;
constexpr double kBodyReach_m = 0.6;  // of a trajectory from its searched way, at the same time
constexpr int kGoalSteps = 4;
constexpr double kGoalSpeedShare = 0.8;  // of the greatest speed
constexpr double kBrakingShare = 0.5;    // of the greatest acceleration, for the room to stop
constexpr std::array<double, 3> kGoalSpeeds = {1.0, 0.6, 0.3};  // parts of the target's speed tried

// What a goal costs in expectation over the target's paths: squared metres outside the ring, and a
// fixed price of not seeing.
double expected_cost(const SearchContext& context, const ExpectedTarget& target, const Vec3& goal) {
  double cost = 0.0;
  for (int i = 0; i < target.count; ++i) {
    const Vec3& z = target.paths[i].positions_enu_m.back();
    const double off_m = std::max(
        0.0, std::abs(distance_xy(goal, z) - context.wanted_distance_m) - context.ring_tolerance_m);
    const bool seen = sees(context.map, z, goal, context.params.horizon.target_radius_m);
    cost += target.paths[i].probability * (off_m * off_m + (seen ? 0.0 : kHiddenCost));
  }
  return cost;
}

// The best of a grid around the path's end, within the last polytope.
Vec3 choose_goal(const SearchContext& context, const ExpectedTarget& target, const Vec3& end,
                 const Polytope& room) {
  Vec3 best = end;
  if (target.count == 1) return best;
  double least = expected_cost(context, target, end);
  for (int iy = -kGoalSteps; iy <= kGoalSteps; ++iy)
    for (int ix = -kGoalSteps; ix <= kGoalSteps; ++ix) {
      const Vec3 goal = end + kGoalStep_m * Vec3(ix, iy, 0.0);
      if (!room.contains(goal, -context.params.place.search_clearance_m)) continue;
      const double cost =
          expected_cost(context, target, goal) + kGoalShiftCost * (goal - end).squaredNorm();
      if (cost < least) least = cost, best = goal;
    }
  return best;
}

Vec3 mean_velocity(const ExpectedTarget& target) {
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < target.count; ++i)
    mean += target.paths[i].probability * target.paths[i].velocities_enu_m_s.back();
  return mean;
}

// The target's velocity at the horizon, as much of it as leaves room to stop after the goal.
Vec3 goal_velocity(const SearchContext& context, const Vec3& goal, const Vec3& target_velocity) {
  const FlightLimits& limits = context.limits;
  Vec3 wanted(target_velocity.x(), target_velocity.y(), 0.0);
  const double most_m_s = kGoalSpeedShare * limits.speed_max_m_s;
  const double speed_m_s = wanted.norm();
  if (speed_m_s > most_m_s) wanted *= most_m_s / speed_m_s;
  for (const double part : kGoalSpeeds) {
    Vec3 velocity = part * wanted;
    const double room_s = velocity.norm() / (kBrakingShare * limits.acceleration_max_m_s2);
    if (is_clear(context.map, goal, goal + 0.6 * room_s * velocity,
                 context.params.check.vehicle_radius_m))
      return velocity;
  }
  return Vec3::Zero();
}

// Where the searched way is t_s after its start; its end afterwards.
Vec3 place_at(const FlightPath& path, double t_s) {
  std::size_t i = 0;
  while (i + 2 < path.vertices.size() && path.times_s[i + 1] < t_s) ++i;
  const double duration_s = path.times_s[i + 1] - path.times_s[i];
  const double share = duration_s > 0.0 ? (t_s - path.times_s[i]) / duration_s : 1.0;
  return path.vertices[i] + std::clamp(share, 0.0, 1.0) * (path.vertices[i + 1] - path.vertices[i]);
}

// The hull, what the vehicle leaves its plan by, and the map's own error.
double tube_radius_m(const SearchContext& context, const DeviationBound& deviation,
                     double speed_m_s) {
  return context.params.body.hull_radius_m + deviation.bound_m(speed_m_s) +
         0.5 * context.map.resolution_m;
}

}  // namespace

bool build_corridor(const SearchContext& context, const FlightPath& path,
                    const DeviationBound& deviation, CorridorWorkspace& workspace,
                    std::vector<Polytope>& corridor) {
  const double checked_m = context.params.check.vehicle_radius_m;
  CorridorParams params{checked_m, context.params.place.corridor_reach_m,
                        context.params.place.corridor_height_m};
  resize_polytopes(workspace, corridor, path.vertices.size() - 1);
  bool clear = true;
  for (std::size_t i = 0; i < corridor.size(); ++i) {
    const Vec3 &from = path.vertices[i], &to = path.vertices[i + 1];
    // A place that is nearer to obstacles than allowed may be left, but not nearer to them.
    const double most_m =
        std::min(context.map.unfree_distance_m(from), context.map.unfree_distance_m(to));
    const auto decompose = [&](double radius_m) {
      params.vehicle_radius_m = std::min(radius_m, most_m);
      return decompose_segment(context.map, from, to, params, workspace, corridor[i]);
    };
    // Between its ends the way may be narrower.
    const double speed_m_s = (to - from).norm() / (path.times_s[i + 1] - path.times_s[i]);
    const double wanted_m = checked_m + context.params.place.corridor_clearance_m;
    clear &= decompose(std::max(tube_radius_m(context, deviation, speed_m_s), wanted_m)) ||
             decompose(wanted_m) || decompose(checked_m);
  }
  return clear;
}

void add_bodies(const SearchContext& context, const FlightPath& path,
                OptimizationProblem& problem) {
  const GapParams& body = context.params.body;
  problem.hull_radius_m = body.hull_radius_m;
  problem.gap_wanted_m = body.gap_wanted_m;
  problem.bodies.clear();
  if (context.courses == nullptr) return;
  for (int i = 1; i * kBodyStep_s <= problem.min_total_duration_s; ++i) {
    const double t_s = i * kBodyStep_s;
    const Vec3 place = place_at(path, t_s);
    for (const BodyCourse& course : context.courses->all()) {
      if (t_s > course.horizon_s || problem.bodies.size() == problem.bodies.capacity()) continue;
      const Vec3 foot = course.body.expected_at(context.start_s + t_s);
      const double touched_m = body.gap_wanted_m + body.hull_radius_m + course.body.radius_m;
      if (distance_xy(place, foot) > touched_m + kBodyReach_m) continue;
      const double discount = std::exp(-context.params.horizon.later_discount_per_s * t_s);
      problem.bodies.push_back(
          {t_s, course.probability * discount, {foot, course.body.radius_m, course.body.height_m}});
    }
  }
}

void guess_trajectory(const SearchContext& context, const FlightPath& path, const PlanStart& start,
                      const ExpectedTarget& target, OptimizationProblem& problem) {
  problem.start = start.state;
  problem.goal.position =
      choose_goal(context, target, path.vertices.back(), problem.corridor.back());
  problem.goal.velocity = goal_velocity(context, problem.goal.position, mean_velocity(target));
  problem.goal.acceleration = Vec3::Zero();
  problem.inner_waypoints.clear();
  problem.durations_s.clear();
  for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
    const Vec3 span = path.vertices[i + 1] - path.vertices[i];
    for (int j = 0; j < kPiecesPerPolytope; ++j) {
      if (i + static_cast<std::size_t>(j) > 0)
        problem.inner_waypoints.emplace_back(path.vertices[i] +
                                             span * (static_cast<double>(j) / kPiecesPerPolytope));
      problem.durations_s.push_back((path.times_s[i + 1] - path.times_s[i]) / kPiecesPerPolytope);
    }
  }
  problem.min_total_duration_s =
      context.params.horizon.step_s * static_cast<double>(target.paths[0].positions_enu_m.size());
  problem.height_above_target_m =
      context.surface.level_z_m - target.paths[0].positions_enu_m.front().z();
  problem.limits = context.limits;
}

}  // namespace foretrack
