// SPDX-License-Identifier: Apache-2.0
// What is believed of the target in this replan: it is seen, searched for, or given up.
#pragma once

#include "core/planning/plan_input.hpp"
#include "core/planning/planning_state.hpp"

namespace foretrack {

/// Takes the target and its prediction into the belief, or remembers the last one while a lost
/// target is searched for. kOk: there is a belief to plan by (state.lost() says whether the target
/// is searched for). kNoTarget: none was ever seen. kTargetLost: the search is over.
PlanReason expect_target(PlanningState& state, const PlanInput& input, const HorizonParams& params);

}  // namespace foretrack
