// SPDX-License-Identifier: Apache-2.0
// What one replan is given.
#pragma once

#include "core/common/framing.hpp"
#include "core/common/grid_map.hpp"
#include "core/common/moving_body.hpp"
#include "core/common/prediction.hpp"
#include "core/common/target.hpp"
#include "core/common/vehicle.hpp"
#include "core/planning/plan_params.hpp"

namespace foretrack {

/// World ENU. The planner reads what the pointers point to during plan() only.
struct PlanInput {
  double now_s = 0.0;
  VehicleState vehicle;
  TargetState target;
  const IntentionAssessment* intention = nullptr;  // null: no margins beyond the least
  const Prediction* prediction = nullptr;          // null: constant velocity
  const GridMap* map = nullptr;                    // null: nothing can be planned
  const MovingBodies* bodies = nullptr;            // everybody who moves; null: nobody is known
  bool flies_plans = true;  // false: the vehicle does something else, and a plan begins there
  Framing framing = {};     // as an operator ordered
  bool waits = false;       // nobody is to be followed now: the vehicle stands, and looks on
};

/// The same without what has come too long ago: a stale target is lost; stale predictions,
/// intentions, bodies or maps are null. A map with stamp 0 is known and never too old.
PlanInput without_stale(PlanInput input, const HorizonParams& params);

}  // namespace foretrack
