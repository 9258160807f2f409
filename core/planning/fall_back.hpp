// SPDX-License-Identifier: Apache-2.0
// What is flown when nothing new passed the check.
#pragma once

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Makes the shortest stop from the task's start the next candidate, with the camera held, and
/// checks it.
PlanReason try_stop(PlanningState& state, const PlanTask& task, StageClock& clock);

/// The best that is possible without a new way. The flown trajectory and its stop tail fly on
/// (kKept, kHold once it stands) if they are still clear in this map and of everybody who moves.
/// Where somebody comes too near, or nothing is clear any more, the least gap cost decides between
/// what is flown, the candidate that failed by its gaps alone, and the evasions (the latter two:
/// kFresh or kSearch with the reason). If none of them is clear of the map, or
/// nothing that was flown is clear and nobody is near, the vehicle brakes
/// (kHold), whatever the check says of that.
const PlanResult& fall_back(PlanningState& state, const PlanTask& task, PlanReason reason,
                            StageClock& clock);

/// For inputs that nothing can be decided by: what is flown flies on unchecked (kStaleInput).
const PlanResult& refuse(PlanningState& state);

}  // namespace foretrack
