// SPDX-License-Identifier: Apache-2.0
// What is flown when nothing new passed the check.
#pragma once

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Makes the shortest stop from the task's start the next candidate, with the camera held, and
/// checks it.
PlanReason try_stop(PlanningState& state, const PlanTask& task, StageClock& clock);

/// The best that is possible without a new way. The first of these that can be had:
/// - What is flown, and its stop tail, if they are still clear in this map and of everybody who
///   moves: kKept, or kHold once the vehicle stands.
/// - If somebody comes too near, or nothing that was flown is clear: what costs least in gaps.
///   Considered are what is flown, the candidate that failed by its gaps alone, and the evasions.
///   The latter two are kFresh or kSearch, with the reason.
/// - A braking manoeuvre (kHold), whatever the check says of it. So it ends if nothing else is
///   clear of the map, or if nothing that was flown is clear and nobody is near.
const PlanResult& fall_back(PlanningState& state, const PlanTask& task, PlanReason reason,
                            StageClock& clock);

/// For inputs that nothing can be decided by: what is flown flies on unchecked (kStaleInput).
const PlanResult& refuse(PlanningState& state);

}  // namespace foretrack
