// SPDX-License-Identifier: Apache-2.0
// The trajectories of a search: along the chosen way, and of who waits where a search has ended.
#pragma once

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// One step of the belief over where a lost person can be, and of the choice of a viewpoint. A
/// search that has lasted too long goes on believing, and flies nowhere.
void search_on(PlanningState& state, const PlanInput& input, const PlanStart& start, bool flies,
               const PlanningParams& params);

/// Flies along the way to the chosen viewpoint, the camera on the gaze. kOk: the next candidate
/// (state.next_result()) passed the check.
PlanReason search_target(PlanningState& state, const PlanTask& task, StageClock& clock);

/// Stands, and looks at the likeliest place. As above.
PlanReason wait_for_target(PlanningState& state, const PlanTask& task, StageClock& clock);

}  // namespace foretrack
