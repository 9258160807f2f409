// SPDX-License-Identifier: Apache-2.0
// From an optimisation problem to a trajectory that passed the check, in up to three attempts.
#pragma once

#include <optional>

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Optimises state.problem and checks the result, which is the next candidate. A second attempt is
/// slower, ends at rest, and weighs the hard limits more; a third one hardly cares for sight and
/// distance. kOk: the candidate passed the check. Else the reason why the first attempt failed.
/// state.problem is left with the slower first guess once a second attempt was made.
PlanReason attempt_all(PlanningState& state, const PlanTask& task,
                       const std::optional<QuinticPiece>& first, StageClock& clock);

/// Points the camera to where the target is expected, and holds it if nobody is expected.
void aim(PlanningState& state, const PlanTask& task, PlannedTrajectory& trajectory);

/// Checks a trajectory from the task's start, and sets that start.
CheckResult check(const PlanningState& state, const PlanTask& task, PlannedTrajectory& trajectory,
                  Passable passable = Passable::kSeenFree);

/// Checks the next candidate as a trajectory from the task's start. The diagnostics keep the
/// result.
PlanReason check_candidate(PlanningState& state, const PlanTask& task);

}  // namespace foretrack
