// SPDX-License-Identifier: Apache-2.0
// A lock-step flight of the whole tracker: what `foretrack fly` and the benchmarks call.
#pragma once

#include "services/offline/flight/tracker_pilot.hpp"

namespace foretrack {

/// The limits and the distance band of the metrics are those that the planner was given.
MetricParams metric_params_of(const TrackerParams& params);

/// Is shown what the tracker put out in each step.
using TrackerWatch = std::function<void(const TrackerOutput&)>;

/// Flies the scenario with the tracker. The same scenario and parameters give the same rows, on any
/// machine with the same program. With colour images, the person is loaded and the pose network
/// sees for the tracker; throws std::runtime_error that says what of them is missing, and how to
/// get it.
FlightResult fly(const Scenario& scenario, const TrackerParams& params,
                 const FlightOptions& options = {}, const TrackerWatch& watch = {});

}  // namespace foretrack
