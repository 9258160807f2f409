// SPDX-License-Identifier: Apache-2.0
// Options that every command with a scenario has.
#pragma once

#include <CLI/CLI.hpp>

#include "services/files/config/load_scenario.hpp"
#include "services/launch/flight_processes.hpp"

namespace foretrack {

inline void add_settings(CLI::App& app, ScenarioOverrides& overrides) {
  app.add_option("--set", overrides.settings,
                 "KEY=VALUE of the scenario instead of the file's, as target.speed_m_s=2.0");
}

/// Of the processes that fly a scenario's vehicles; none if it has one vehicle without a name.
inline std::vector<FleetNames> fleet_names_of(const Scenario& scenario) {
  std::vector<FleetNames> names;
  for (const FleetVehicle& vehicle : scenario.vehicles)
    names.push_back({vehicle.name, px4_namespace_of(names.size())});
  return names;
}

inline void add_vehicles(CLI::App& app, ScenarioOverrides& overrides) {
  app.add_option("--vehicles", overrides.vehicles,
                 "So many vehicles follow together; default: as the scenario says")
      ->check(CLI::Range(1, 16));
}

}  // namespace foretrack
