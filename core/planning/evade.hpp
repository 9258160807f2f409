// SPDX-License-Identifier: Apache-2.0
// Ways out when somebody comes too near, whatever else is planned.
#pragma once

#include <optional>

#include "core/planning/plan_task.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Tries a small fixed set of evasive trajectories that end at rest: stop, straight up, and away
/// from the nearest body, aside, on diagonals and back past it, each level and rising. The one with
/// the least gap cost (measure_gaps) that passes the check, but for the gaps, is left in
/// state.evading; the check's result is returned. None if nothing passed whose cost is below
/// cost_to_beat_m3s. A way through what nobody has seen is tried by the caller's leave only: it may
/// meet what is not in the map, and leads steeply up. The camera looks at the target where one is
/// expected. Cost: below half a millisecond with eight bodies.
std::optional<CheckResult> evade(PlanningState& state, const PlanTask& task,
                                 double cost_to_beat_m3s, Passable passable = Passable::kSeenFree);

}  // namespace foretrack
