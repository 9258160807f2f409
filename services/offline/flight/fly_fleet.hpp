// SPDX-License-Identifier: Apache-2.0
// A lock-step flight of several vehicles behind one person, with a radio between them.
#pragma once

#include "services/offline/flight/fleet_metrics.hpp"
#include "services/offline/flight/fly.hpp"

namespace foretrack {

struct FleetFlight {
  std::vector<std::string> names;
  std::vector<FlightResult>
      vehicles;                // in the order of scenario.vehicles, with rows at equal times
  std::vector<FleetRow> rows;  // one for each step
  FleetMetrics metrics;
};

/// What a message weighs as DDS writes it, without headers of the network.
double bytes_of(const FleetMember& member);

/// Flies all of scenario.vehicles with the tracker. The same scenario and parameters give the same
/// rows. Throws std::invalid_argument for a scenario that cannot be.
FleetFlight fly_fleet(const Scenario& scenario, const TrackerParams& params,
                      const FlightOptions& options = {});

}  // namespace foretrack
