// SPDX-License-Identifier: Apache-2.0
// A candidate becomes what is flown, with what is told beside it: to be drawn, and how much work
// it was.
#pragma once

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Makes the next candidate the flown trajectory. Fills in its id, stamp, status (kFresh, or
/// kSearch for a lost target), reason and corridor, and a visible region for each time step of the
/// likeliest path. Those steps begin way_begin_s after the trajectory does.
const PlanResult& publish(PlanningState& state, const PlanTask& task, double way_begin_s,
                          const StageClock& clock);

/// Fills in counts and times of the last replan.
void count_work(const PlanningState& state, const StageClock& clock, PlanDiagnostics& diagnostics);

}  // namespace foretrack
