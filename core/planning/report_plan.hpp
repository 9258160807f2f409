// SPDX-License-Identifier: Apache-2.0
// What a plan tells beside the trajectory: to be drawn, and how much work it was.
#pragma once

#include "core/planning/plan.hpp"
#include "core/planning/stage_clock.hpp"

namespace foretrack {

/// The corridor, and the visible region of each time step of the likeliest path, where those steps
/// begin begin_s after the trajectory.
void fill_views(PlanningState& state, double begin_s, double step_s, PlannedTrajectory& trajectory);

/// Counts and times of the last replan.
void count_work(const PlanningState& state, const StageClock& clock, PlanDiagnostics& diagnostics);

}  // namespace foretrack
