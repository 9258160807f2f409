// SPDX-License-Identifier: Apache-2.0
// What the optimiser is to keep, as samples of the target's paths.
#pragma once

#include "core/planning/motion/plan_start.hpp"
#include "core/planning/see/look_ahead.hpp"

namespace foretrack {

/// One sample for each z_k of each path, weighted by probability and time; z_k of paths that run
/// together are one sample. Distances and regions that the vehicle cannot be in by t_k, however it
/// accelerates, are widened to what it can: an impossible demand would break the limits instead.
/// `score_decelerate` is Π_dec; `timing` is that of make_flight_path.
void make_samples(const SearchContext& context, const ExpectedTarget& expected,
                  const LookAhead& ahead, const FlightPathWorkspace& timing,
                  const BoundaryState& start, double score_decelerate,
                  std::vector<TargetSample>& samples);

}  // namespace foretrack
