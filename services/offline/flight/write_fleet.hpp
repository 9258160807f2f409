// SPDX-License-Identifier: Apache-2.0
// A flight of several vehicles as files.
#pragma once

#include "services/offline/flight/fly_fleet.hpp"
#include "services/offline/flight/write_flight.hpp"

namespace foretrack {

/// {"fleet": …, "vehicles": {name: as of one vehicle's flight}}. Fields: docs/metrics.md.
std::string json_of(const FleetFlight& flight);

/// A few lines for people.
std::string to_text(const FleetFlight& flight);

/// Writes metrics.json, and a folder for each vehicle with the files of its flight. Throws
/// std::runtime_error that names a file which cannot be written.
void write_fleet_flight(const FleetFlight& flight, const MetricParams& params,
                        const std::filesystem::path& folder);

}  // namespace foretrack
