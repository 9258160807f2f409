// SPDX-License-Identifier: Apache-2.0
// A whole flight in simulation: starts it, watches it, measures it, writes it down.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/simulator/scenario.hpp"
#include "services/launch/flight_processes.hpp"

namespace foretrack {

struct DemoOptions {
  FlightSpec spec;
  Scenario scenario;  // that spec names, with its overrides
  std::filesystem::path folder;
  bool headless = false;
  std::optional<ProcessSpec> station;  // beside the flight
  std::string page;                    // its address; empty: there is none
};

/// Returns when the flight is over, or after Ctrl-C. Writes log.csv, metrics.json, summary.json,
/// flight.png and logs/ into the folder; tells people on standard output. The exit status: 0 if the
/// vehicle flew without a collision.
int fly_demo(const DemoOptions& options);

}  // namespace foretrack
