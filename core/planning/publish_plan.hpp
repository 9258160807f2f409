// SPDX-License-Identifier: Apache-2.0
// A candidate becomes what is flown, with what is told beside it: to be drawn, and how much work
// it was.
#pragma once

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Makes the next candidate the flown trajectory: id, stamp, status (kFresh, or kSearch for a lost
/// target) and reason, the corridor, and the visible region of each time step of the likeliest
/// path, where those steps begin way_begin_s after the trajectory.
const PlanResult& publish(PlanningState& state, const PlanTask& task, double way_begin_s,
                          const StageClock& clock);

/// Fills in counts and times of the last replan.
void count_work(const PlanningState& state, const StageClock& clock, PlanDiagnostics& diagnostics);

}  // namespace foretrack
