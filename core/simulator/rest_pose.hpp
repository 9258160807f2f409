// SPDX-License-Identifier: Apache-2.0
// The pose in which a person was modelled, made simple.
#pragma once

#include "core/simulator/person_model.hpp"

namespace foretrack {

/// Turns a mesh and its skeleton so that hips and shoulders look ahead, as those of the simulated
/// person do. People are modelled with their shoulders turned against their hips. Each height is
/// turned about the spine, between hips and shoulders by a part.
void unwind(PersonMesh& mesh, Skeleton& skeleton);

/// Which leg each vertex belongs to: 0 the left one, 1 the right one. Below the knees, vertices
/// that hang together belong to one leg, however near the other one is. Above the knees, the side
/// counts on which the vertex is.
std::vector<int> leg_of_each_vertex(const PersonMesh& mesh, const Skeleton& skeleton);

/// Distance from p to the segment between two points, which must differ.
float distance_to_segment(const Eigen::Vector3f& p, const Eigen::Vector3f& from,
                          const Eigen::Vector3f& to);

}  // namespace foretrack
