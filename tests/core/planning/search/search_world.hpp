// SPDX-License-Identifier: Apache-2.0
// A wall with doors, and somebody who was lost behind it.
#pragma once

#include "core/planning/search/lost_person.hpp"
#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack::testing {

/// A wall along x at y = 0 … 0.3, with doors 0.64 m wide.
inline World wall_with_doors(std::initializer_list<double> doors_x_m, double half_m = 12.0) {
  World world = empty_world(half_m);
  double from_m = -half_m;
  for (const double x : doors_x_m) {
    world.boxes.push_back({{from_m, 0.0, 0.0}, {x - 0.32, 0.3, 4.0}});
    from_m = x + 0.32;
  }
  world.boxes.push_back({{from_m, 0.0, 0.0}, {half_m, 0.3, 4.0}});
  return world;
}

/// Somebody who walks along one path.
inline TargetBelief belief_of(const Vec3& at, const Vec3& velocity, double stamp_s,
                              double path_s = 3.0) {
  TargetBelief belief;
  belief.stamp_s = stamp_s;
  belief.count = 1;
  belief.paths[0].probability = 1.0;
  for (double t = 0.2; t < path_s + 0.01; t += 0.2) {
    PredictedState state;
    state.time_s = t;
    state.position_enu_m = at + t * velocity;
    state.velocity_enu_m_s = velocity;
    belief.paths[0].states.push_back(state);
  }
  return belief;
}

}  // namespace foretrack::testing
