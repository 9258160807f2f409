// SPDX-License-Identifier: Apache-2.0
// What one replan sets out from.
#pragma once

#include "core/planning/motion/plan_start.hpp"
#include "core/planning/plan_input.hpp"

namespace foretrack {

/// Decided once at the beginning of a replan; nothing in it changes while a way is looked for.
struct PlanTask {
  const PlanInput& input;
  const PlanningParams& params;
  FlightLimits limits;  // of the parameters; slower while a lost target is searched for
  PlanStart start;      // where the new trajectory joins what is flown
  bool lost = false;    // the target is searched for
};

}  // namespace foretrack
