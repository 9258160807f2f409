#include "core/planning/assemble_problem.hpp"

#include <algorithm>
#include <array>

#include "core/planning/map_rays.hpp"

namespace foretrack {
namespace {

constexpr double kGoalSpeedShare = 0.8;  // of the greatest speed
constexpr double kBrakingShare = 0.5;    // of the greatest acceleration, for the room to stop
constexpr std::array<double, 3> kGoalSpeeds = {1.0, 0.6, 0.3};  // parts of the target's speed tried

// The target's velocity at the horizon, as much of it as leaves room to stop after the goal.
Vec3 goal_velocity(const SearchContext& context, const Vec3& goal, const Vec3& target_velocity) {
  const FlightLimits& limits = context.params.limits;
  Vec3 wanted(target_velocity.x(), target_velocity.y(), 0.0);
  const double most_m_s = kGoalSpeedShare * limits.speed_max_m_s;
  const double speed_m_s = wanted.norm();
  if (speed_m_s > most_m_s) wanted *= most_m_s / speed_m_s;
  for (const double part : kGoalSpeeds) {
    const Vec3 velocity = part * wanted;
    const double room_s = velocity.norm() / (kBrakingShare * limits.acceleration_max_m_s2);
    if (is_clear(context.map, goal, goal + 0.6 * room_s * velocity,
                 context.params.check.vehicle_radius_m))
      return velocity;
  }
  return Vec3::Zero();
}

}  // namespace

bool build_corridor(const SearchContext& context, const FlightPath& path,
                    CorridorWorkspace& workspace, std::vector<Polytope>& corridor) {
  const double radius_m = context.params.check.vehicle_radius_m;
  CorridorParams params{radius_m, context.params.place.corridor_reach_m,
                        context.params.place.corridor_height_m};
  resize_polytopes(workspace, corridor, path.vertices.size() - 1);
  const auto allowed_m = [&](const Vec3& vertex) {
    return std::min(radius_m, context.map.unfree_distance_m(vertex));
  };
  bool clear = true;
  for (std::size_t i = 0; i < corridor.size(); ++i) {
    // A place that is nearer to obstacles than allowed may be left, but not nearer to them.
    const Vec3 &from = path.vertices[i], &to = path.vertices[i + 1];
    params.vehicle_radius_m = std::min(allowed_m(from), allowed_m(to));
    clear &= decompose_segment(context.map, from, to, params, workspace, corridor[i]);
  }
  return clear;
}

void guess_trajectory(const SearchContext& context, const FlightPath& path, const PlanStart& start,
                      const ExpectedPath& target, OptimizationProblem& problem) {
  problem.start = start.state;
  problem.goal.position = path.vertices.back();
  problem.goal.velocity =
      goal_velocity(context, path.vertices.back(), target.velocities_enu_m_s.back());
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
      context.params.horizon.step_s * static_cast<double>(target.positions_enu_m.size());
  problem.height_above_target_m = context.surface.level_z_m - target.positions_enu_m.front().z();
  problem.limits = context.params.limits;
}

}  // namespace foretrack
