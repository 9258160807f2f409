// SPDX-License-Identifier: Apache-2.0
// A flight as files: log.csv, scenario.json, metrics.json, log.sha256 and flight.png.
#pragma once

#include <filesystem>
#include <string>

#include "services/offline/flight/fly_pilot.hpp"

namespace foretrack {

/// The world, the turns and the band for the plot, as JSON.
std::string scenario_json_of(const FlightResult& flight, const MetricParams& params);

/// Writes all but the plot; makes the folder. Returns the log's SHA-256. Throws std::runtime_error
/// that names a file which cannot be written.
std::string write_flight(const FlightResult& flight, const MetricParams& params,
                         const std::filesystem::path& folder);

/// Draws flight.png from the folder's files with deploy/plot/plot_flight.py. Throws
/// std::runtime_error that says what is missing (Python 3 with matplotlib).
void plot_flight(const std::filesystem::path& folder);

}  // namespace foretrack
