// SPDX-License-Identifier: Apache-2.0
// Yaw, and a gimbal's pitch, along a trajectory.
#pragma once

#include "core/planning/motion/plan_start.hpp"
#include "core/planning/motion/yaw_plan.hpp"
#include "core/planning/see/target_belief.hpp"

namespace foretrack {

/// Workspace of aim_camera.
struct AimWorkspace {
  AnglePlanWorkspace angles;
  std::vector<double> yaws_rad, pitches_rad;
};

/// Plans yaw (and gimbal pitch) so that the camera points at where the target is expected: the mean
/// direction over the paths, weighted by their probabilities; after the horizon, where they end.
void aim_camera(const PlanStart& start, const ExpectedTarget& expected,
                const PlanningParams& params, AimWorkspace& workspace,
                PlannedTrajectory& trajectory);

/// Brakes yaw (and pitch) to rest.
void hold_camera(const PlanStart& start, const PlanningParams& params, AimWorkspace& workspace,
                 PlannedTrajectory& trajectory);

}  // namespace foretrack
