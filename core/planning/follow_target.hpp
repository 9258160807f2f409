// SPDX-License-Identifier: Apache-2.0
// The paper's §V: from the expected target to a checked trajectory that keeps it in view.
#pragma once

#include <optional>

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Looks for a way to places that see the target, and flies along it. kOk: the next candidate
/// (state.next_result()) passed the check. `first`, if there is one, is flown before that way: a
/// stop at the task's start, from whose end the way then leads on.
PlanReason follow_target(PlanningState& state, const PlanTask& task,
                         const std::optional<QuinticPiece>& first, StageClock& clock);

}  // namespace foretrack
