// SPDX-License-Identifier: Apache-2.0
// When what befalls the vehicles of a fleet.
#pragma once

#include "core/simulator/scenario.hpp"

namespace foretrack {

/// Of one kind, in the scenario's time. Never: after all times; who need not join is there from
/// before the begin.
inline double failure_s(const Scenario& scenario, std::string_view vehicle, FleetFailureKind kind) {
  for (const FleetFailure& failure : scenario.failures)
    if (failure.vehicle == vehicle && failure.kind == kind) return failure.at_s;
  return kind == FleetFailureKind::kJoins ? -1.0 : 1e18;
}

/// It has joined, and not died.
inline bool is_there_at(const Scenario& scenario, std::string_view vehicle, double time_s) {
  return time_s >= failure_s(scenario, vehicle, FleetFailureKind::kJoins) &&
         time_s < failure_s(scenario, vehicle, FleetFailureKind::kDies);
}

}  // namespace foretrack
