// SPDX-License-Identifier: Apache-2.0
// What is flown when no new plan passed the check.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/planning/motion/aim_camera.hpp"

namespace foretrack {

/// Whether the rest of a trajectory, from t_s on, is as far from what is not free as the check
/// asks, or at least never nearer than where it is now. Points are at most half a cell apart.
bool rest_is_clear(const GridMap& map, const PlannedTrajectory& trajectory, double t_s,
                   double required_m);

/// The shortest stop from the start state, with the camera held.
void make_stop(const PlanStart& start, const PlanningParams& params, AimWorkspace& workspace,
               PlannedTrajectory& trajectory);

}  // namespace foretrack
