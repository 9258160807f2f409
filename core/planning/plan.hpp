// SPDX-License-Identifier: Apache-2.0
// One replan: a trajectory that keeps the person in view (paper §V), checked before it is given
// out.
#pragma once

#include "core/planning/plan_input.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Plans from what is flown (or, without it, from where the vehicle is), and returns what is to be
/// flown now. The result lives in `state` until the next call but one.
///
/// trajectory.status of the result:
/// - kFresh: new, and it passed the check. With a reason other than kOk it is
/// what keeps clearest of people and vehicles of all that can be flown now (it goes back, aside or
/// up), as nothing that follows the target keeps clear enough; it passed all of the check but,
/// perhaps, the gaps.
/// - kSearch: new, passed the check, and leads to where the lost target is
/// believed to be.
/// - kKept: no new trajectory was found; the last one and its stop tail fly on,
/// as they are still clear in this map and of everybody who moves. kHold: the same, once it stands.
/// - kHold with a new id: nothing that was flown is clear any more; the vehicle
/// brakes.
/// - kNone: there is no vehicle state to start from, and nothing was flown
/// before. Where the present motion leaves no room to turn into a way, a new trajectory begins with
/// a stop.
///
/// Never throws. Bad or stale inputs are reasons. Work is bounded by counts, not by a clock: the
/// same calls give the same results. Allocates nothing after the first plans. Cost: below a
/// millisecond.
const PlanResult& plan(PlanningState& state, const PlanInput& input, const PlanningParams& params);

}  // namespace foretrack
