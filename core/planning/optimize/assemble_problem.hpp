// SPDX-License-Identifier: Apache-2.0
// The optimisation problem of one plan: corridor, first guess, boundary states.
#pragma once

#include "core/common/deviation_bound.hpp"
#include "core/planning/motion/plan_start.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"
#include "core/planning/see/look_ahead.hpp"
#include "core/planning/way/corridor.hpp"

namespace foretrack {

/// Makes one polytope of free space for each segment of the path (paper: F). Where there is room,
/// it keeps as far from obstacles as the vehicle leaves plans of that speed; elsewhere, as far as
/// the check asks. Where a segment begins or ends too near to obstacles, its polytope comes no
/// nearer to them than that. False if a segment touches what the vehicle may not enter.
bool build_corridor(const SearchContext& context, const FlightPath& path,
                    const DeviationBound& deviation, CorridorWorkspace& workspace,
                    std::vector<Polytope>& corridor);

/// Writes the first guess and the boundary states.
/// - Waypoints: the path's vertices, and the middles of its segments.
/// - Start: that of the plan.
/// - End: a place near the path's end, in the last polytope. It is the one with the best distance
///   and sight, in expectation over the ends of the target's paths. The velocity there is the
///   target's mean one, or as much of it as leaves room to stop.
/// Reads the corridor. Does not change the corridor or the samples.
void guess_trajectory(const SearchContext& context, const FlightPath& path, const PlanStart& start,
                      const ExpectedTarget& target, OptimizationProblem& problem);

/// Adds samples of everybody who moves and may come near the path: where they are expected, every
/// 0.1 s, until their course or the planned horizon ends. Call guess_trajectory()
/// first.
void add_bodies(const SearchContext& context, const FlightPath& path, OptimizationProblem& problem);

}  // namespace foretrack
