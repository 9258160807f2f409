// SPDX-License-Identifier: Apache-2.0
#include "core/planning/expect_target.hpp"

namespace foretrack {
namespace {

bool is_finite(const TargetState& target) {
  return target.position_enu_m.allFinite() && target.velocity_enu_m_s.allFinite() &&
         std::isfinite(target.stamp_s);
}

}  // namespace

PlanReason expect_target(PlanningState& state, const PlanInput& input,
                         const HorizonParams& params) {
  const TargetState& target = input.target;
  if (target.usable() && is_finite(target)) {
    // Out of sight, the target goes on as its intentions were; constant velocity knows less.
    if (target.status == TrackStatus::kTracking || !state.seen_before)
      update_belief(state.belief, target, input.prediction, params);
    state.seen_before = true;
    state.lost_since_s = -1.0;
    state.search.active = false;
    return PlanReason::kOk;
  }
  if (!state.seen_before) return PlanReason::kNoTarget;
  if (!state.lost()) state.lost_since_s = input.now_s;
  const bool searching = input.now_s - state.lost_since_s < params.search_s;
  return searching ? PlanReason::kOk : PlanReason::kTargetLost;
}

}  // namespace foretrack
