// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/scenario.hpp"

#include "core/common/random.hpp"
#include "core/simulator/route.hpp"

namespace foretrack {
namespace {

std::vector<Vec2> given_path(const TargetSpec& target) {
  if (target.track.empty()) return target.route_m;
  std::vector<Vec2> path;
  for (const auto& point : target.track) path.push_back(point.position_m);
  return path;
}

}  // namespace

std::uint64_t seed_of(const Scenario& scenario, std::uint64_t part) {
  return Random(scenario.seed * 16 + part).next();
}

World world_of(const Scenario& scenario) {
  const auto path = given_path(scenario.target);
  World world =
      generate_world(scenario.generator, scenario.world.min_m, scenario.world.max_m, path);
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.begin(), from.begin(), from.end());
  };
  append(world.boxes, scenario.world.boxes);
  append(world.cylinders, scenario.world.cylinders);
  return world;
}

Walk walk_of(const Scenario& scenario, const World& world) {
  const TargetSpec& target = scenario.target;
  if (!target.track.empty()) return walk_through(target.track);
  const WalkLimits limits{target.speed_m_s, target.person.acceleration_m_s2, target.corner_reach_m};
  if (!target.route_m.empty()) return walk_along(target.route_m, limits);
  const RouteRequest request{.seed = seed_of(scenario, 2),
                             .length_m = target.speed_m_s * scenario.duration_s,
                             .corner_reach_m = target.corner_reach_m};
  return walk_along(scenario.generator.kind == WorldKind::kTIntersection
                        ? t_intersection_route(request)
                        : generate_route(world, request),
                    limits);
}

}  // namespace foretrack
