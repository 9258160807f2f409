// SPDX-License-Identifier: Apache-2.0
// One replan: a trajectory that keeps the person in view (paper §V), checked before it is given
// out.
#pragma once

#include "core/planning/plan_input.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Makes a new trajectory and returns what is to be flown now: that one, or an older one. A new
/// trajectory goes on from what is flown; if nothing is flown yet, it begins where the vehicle is.
/// If the present motion leaves no room to turn into a way, it begins with a stop. The result lives
/// in `state` until the next call but one.
///
/// trajectory.status says what the result is:
/// - kFresh, reason kOk: a new trajectory, which passed the check.
/// - kFresh, another reason: a new trajectory that evades. Nothing that follows the target keeps
///   clear enough of people and vehicles. Of all that can be flown now, this keeps clearest: it
///   goes back, aside or up. It passed the whole check, except perhaps for the gaps.
/// - kSearch: a new trajectory to where the lost target is believed to be. It passed the check.
/// - kKept: no new trajectory was found. The last one is flown on, and its stop tail after it. Both
///   are still clear in this map, and of everybody who moves.
/// - kHold with the last id: the same, and the vehicle stands already.
/// - kHold with a new id: nothing that was flown is clear any more. The vehicle brakes.
/// - kNone: nothing was flown before, and no state of the vehicle is known to start from.
///
/// Never throws: bad or stale inputs are reasons. Work is bounded by counts, not by a clock, so the
/// same calls give the same results. Allocates nothing after the first plans. Cost: below a
/// millisecond.
const PlanResult& plan(PlanningState& state, const PlanInput& input, const PlanningParams& params);

}  // namespace foretrack
