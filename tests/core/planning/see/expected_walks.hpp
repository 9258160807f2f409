// SPDX-License-Identifier: Apache-2.0
// Targets that are expected to walk, for the tests of the stages that plan for them.
#pragma once

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack::testing {

inline constexpr int kExpectedSteps = 15;
inline constexpr double kExpectedStep_s = 0.2;

/// Adds a path: straight on from a place, and from turn_s on with another velocity.
inline void add_walk(ExpectedTarget& expected, double probability, const Vec3& from,
                     const Vec3& velocity, double turn_s = 1e9, const Vec3& turned = Vec3::Zero()) {
  ExpectedPath& path = expected.paths[expected.count++];
  path.probability = probability;
  path.positions_enu_m.clear();
  path.velocities_enu_m_s.clear();
  for (int k = 1; k <= kExpectedSteps; ++k) {
    const double t_s = kExpectedStep_s * k, after_s = std::max(t_s - turn_s, 0.0);
    path.positions_enu_m.push_back(from + (t_s - after_s) * velocity + after_s * turned);
    path.velocities_enu_m_s.push_back(after_s > 0.0 ? turned : velocity);
  }
}

}  // namespace foretrack::testing
