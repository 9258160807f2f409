// SPDX-License-Identifier: Apache-2.0
// The optimisation problem of one plan: corridor, first guess, boundary states.
#pragma once

#include "core/planning/motion/deviation_bound.hpp"
#include "core/planning/motion/plan_start.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"
#include "core/planning/see/look_ahead.hpp"
#include "core/planning/way/corridor.hpp"

namespace foretrack {

/// Decomposes free space around every segment of the path (paper: F). Where there is room, it is
/// as far from obstacles as the vehicle leaves plans of the segment's speed; where there is not, as
/// the check asks. A segment that begins or ends nearer to obstacles has a polytope that comes no
/// nearer. False if a segment touches what the vehicle may not enter.
bool build_corridor(const SearchContext& context, const FlightPath& path,
                    const DeviationBound& deviation, CorridorWorkspace& workspace,
                    std::vector<Polytope>& corridor);

/// First guess (waypoints at the path's vertices and in the middle of its segments) and boundary
/// states: the plan ends near the path's end, in its last polytope, where distance and sight to the
/// ends of the target's paths are best in expectation, with the target's mean velocity there as far
/// as there is room to stop. Reads the corridor; leaves it and the samples as they are.
void guess_trajectory(const SearchContext& context, const FlightPath& path, const PlanStart& start,
                      const ExpectedTarget& target, OptimizationProblem& problem);

/// The places of everybody who moves that the way may come near to, as samples:
/// 0.1 s apart over each course's horizon, and over as long as the problem
/// lasts. Needs the guess.
void add_bodies(const SearchContext& context, const FlightPath& path, OptimizationProblem& problem);

}  // namespace foretrack
