// SPDX-License-Identifier: Apache-2.0
// The pose in which a person was modelled, made simple.
#pragma once

#include "core/simulator/person_model.hpp"

namespace foretrack {

/// People are modelled with their shoulders turned against their hips. Turns every height about the
/// spine so that hips and shoulders look ahead, as those of the simulated person do.
void unwind(PersonMesh& mesh, Skeleton& skeleton);

/// Whose each vertex is below the knees: 0 the left leg's, 1 the right one's; above: the side that
/// it is on. What hangs together is of one leg, however near the other one is.
std::vector<int> leg_of_each_vertex(const PersonMesh& mesh, const Skeleton& skeleton);

float distance_to_segment(const Eigen::Vector3f& p, const Eigen::Vector3f& from,
                          const Eigen::Vector3f& to);

}  // namespace foretrack
