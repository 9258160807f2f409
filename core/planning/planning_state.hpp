// SPDX-License-Identifier: Apache-2.0
// What the planner keeps from one replan to the next, and the memory that it works in.
#pragma once

#include "core/common/deviation_bound.hpp"
#include "core/planning/frame_target.hpp"
#include "core/planning/motion/aim_camera.hpp"
#include "core/planning/motion/check_trajectory.hpp"
#include "core/planning/search/lost_person.hpp"
#include "core/planning/see/look_ahead.hpp"
#include "core/planning/way/corridor.hpp"

namespace foretrack {

/// How much work the last replan was, and what the check said.
struct PlanDiagnostics {
  int expansions = 0;                              // of all waypoint searches
  int samples = 0;                                 // places of the target that the optimiser saw
  int polytopes = 0;                               // of the corridor
  int planes = 0;                                  // of all polytopes
  int attempts = 0;                                // optimisations that were tried
  int iterations = 0;                              // of all attempts
  int evaluations = 0;                             // the same
  double cost = 0.0;                               // of the last attempt
  CheckResult check;                               // of the last candidate
  std::array<double, kPlanStageCount> stage_ms{};  // zero without a clock
};

/// trajectory.status says what is flown; trajectory.reason says why it is not something better. A
/// trajectory that flies on keeps its id.
struct PlanResult {
  PlannedTrajectory trajectory;
  PlanDiagnostics diagnostics;
};

/// One for each vehicle, owned by the caller and given to each plan(). The caller may set clock_s
/// and last_id before the first plan; everything else belongs to the planner.
struct PlanningState {
  double (*clock_s)() = nullptr;  // for the stages' times in the diagnostics; core reads no clock
  std::uint64_t last_id = 0;      // of the newest trajectory; ids grow by one

  // What is flown, and the place where the next candidate is made.
  std::array<PlanResult, 2> results;
  int flown = 0;
  Passable flown_through = Passable::kSeenFree;  // what the flown trajectory was let through
  PlanResult& flown_result() { return results[flown]; }
  PlanResult& next_result() { return results[1 - flown]; }

  FramingState framing;      // from where the target is seen
  DeviationBound deviation;  // of the vehicle from what is flown

  // What is remembered of the target.
  TargetBelief belief;
  bool seen_before = false;    // there is a belief to search by
  double lost_since_s = -1.0;  // < 0: not lost
  LostPerson search;           // where a lost target can be
  bool lost() const { return lost_since_s >= 0.0; }

  // Results of the steps of one plan, kept for their memory.
  bool reserved = false;  // the memory that later plans need is there
  ExpectedTarget expected;
  BodyCourses courses;
  LookAhead ahead;
  FlightPathWorkspace path_workspace;
  FlightPath path;
  CorridorWorkspace corridor;
  OptimizationProblem problem;
  OptimizerState optimizer;
  AimWorkspace aim;
  TargetBelief watched;       // what a search looks at, as a target that stands there
  PlannedTrajectory evading;  // the best evasion, until it is taken
  int level_tried = 0;        // of the levels beside the wanted one
};

/// Takes the memory that plans need, so that later plans take none. The first plan() does it.
void reserve(PlanningState& state);

}  // namespace foretrack
