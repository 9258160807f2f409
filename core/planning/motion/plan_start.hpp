// SPDX-License-Identifier: Apache-2.0
// The state from which a plan starts.
#pragma once

#include "core/planning/plan_input.hpp"

namespace foretrack {

/// The state and the time that a new trajectory begins with.
struct PlanStart {
  double time_s = 0.0;  // absolute; the trajectory's t = 0
  BoundaryState state;
  AngleNode yaw;
  AngleNode gimbal_pitch;
  bool on_flown = false;  // joins the flown trajectory
};

/// The flown trajectory's state replan_lead_s ahead of now; without one, when no plan is flown, or
/// when the vehicle is further than restart_distance_m from it, the measured state carried on to
/// that time, its speeds brought within the limits.
PlanStart choose_start(const PlannedTrajectory& flown, const PlanInput& input,
                       const PlanningParams& params);

}  // namespace foretrack
