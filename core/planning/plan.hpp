// SPDX-License-Identifier: Apache-2.0
// Planning a trajectory that keeps the person in view (paper §V), checked before it is given out.
#pragma once

#include "core/common/moving_body.hpp"
#include "core/common/target.hpp"
#include "core/common/vehicle.hpp"
#include "core/planning/motion/aim_camera.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/see/look_ahead.hpp"
#include "core/planning/way/corridor.hpp"

namespace foretrack {

struct PlanInput {
  double now_s = 0.0;
  VehicleState vehicle;
  TargetState target;
  const IntentionAssessment* intention = nullptr;  // null: no margins beyond the least
  const Prediction* prediction = nullptr;          // null: constant velocity
  const GridMap* map = nullptr;
  const MovingBodies* bodies = nullptr;  // everybody who moves; null: nobody is known
};

struct PlanDiagnostics {
  int expansions = 0;
  int samples = 0;
  int polytopes = 0;
  int planes = 0;
  int attempts = 0;
  int iterations = 0;
  int evaluations = 0;
  double cost = 0.0;
  CheckResult check;                               // of the last candidate
  std::array<double, kPlanStageCount> stage_ms{};  // zero without a clock
};

/// trajectory.status says what is flown, trajectory.reason why not something better. A trajectory
/// that flies on keeps its id.
struct PlanResult {
  PlannedTrajectory trajectory;
  PlanDiagnostics diagnostics;
};

/// Everything that is kept between plans. One for each vehicle.
struct PlanningState {
  double (*clock_s)() = nullptr;  // for the stages' times in the diagnostics; core reads no clock

  std::array<PlanResult, 2> results;  // what is flown, and the place for the next candidate
  int flown = 0;
  std::uint64_t last_id = 0;
  double lost_since_s = -1.0;  // < 0: not lost
  double search_turn = 1.0;    // +1: the camera of a search turns to the left
  bool seen_before = false;    // there is a belief to search by
  bool reserved = false;       // the memory that later plans need is there

  TargetBelief belief;
  ExpectedTarget expected;
  LookAhead ahead;
  FlightPathWorkspace path_workspace;
  FlightPath path;
  CorridorWorkspace corridor;
  OptimizationProblem problem;
  OptimizerState optimizer;
  AimWorkspace aim;
};

/// Takes the memory that plans need; the first plan() does it.
void reserve(PlanningState& state);

/// One replan. The result lives in `state` until the next call but one.
/// Fresh and searching trajectories passed the check; a fresh one with the reason kTooNearTarget
/// all of it but the distance to the target, from which it keeps further than what was flown. If
/// the present motion leaves no room for one, it begins with a stop. When none is found, the last
/// one and its stop tail fly on (kKept, kHold once it stands) as long as that is still safe in this
/// map; else the vehicle brakes (kHold). kNone: there is no vehicle state to start from. Never
/// throws; bad or stale inputs are reasons. Bounded by counts; allocates nothing after warm-up.
/// Cost: below a millisecond.
const PlanResult& plan(PlanningState& state, const PlanInput& input, const PlanningParams& params);

}  // namespace foretrack
