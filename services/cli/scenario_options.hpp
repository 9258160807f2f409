// SPDX-License-Identifier: Apache-2.0
// Options that every command with a scenario has.
#pragma once

#include <CLI/CLI.hpp>

#include "services/files/config/load_scenario.hpp"

namespace foretrack {

inline void add_settings(CLI::App& app, ScenarioOverrides& overrides) {
  app.add_option("--set", overrides.settings,
                 "KEY=VALUE of the scenario instead of the file's, as target.speed_m_s=2.0");
}

}  // namespace foretrack
