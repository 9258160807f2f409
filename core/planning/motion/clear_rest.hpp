// SPDX-License-Identifier: Apache-2.0
// Whether what is flown may fly on.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/common/trajectory.hpp"

namespace foretrack {

/// True if the rest of a trajectory, from t_s on, keeps required_m from what is not passable, or at
/// least comes no nearer than it is at t_s. Points are at most half a cell apart.
bool rest_is_clear(const GridMap& map, const PlannedTrajectory& trajectory, double t_s,
                   double required_m, Passable passable = Passable::kSeenFree);

}  // namespace foretrack
