// SPDX-License-Identifier: Apache-2.0
// Scenario files: YAML into the simulator's Scenario. docs/scenarios.md has every key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/simulator/scenario.hpp"

namespace foretrack {

/// What a command line changes in a scenario.
struct ScenarioOverrides {
  std::optional<std::uint64_t> seed;  // also of the generated world, unless the file gives that one
  std::optional<MapSource> map;
  std::optional<double> duration_s;
  std::optional<int> vehicles;            // so many: the first of the file's, and others after them
  bool color_images = false;              // rendered, whatever the scenario says
  std::optional<std::string> track_file;  // walk as this recorded pedestrian
  std::optional<int> pedestrian;
  std::optional<double> track_rate_hz;  // frames a second of track_file
  /// "target.speed_m_s=2.0": keys of the file, as if it had said so.
  std::vector<std::string> settings;
};

/// The scenario of a file, or of a shipped name (deploy/scenarios/NAME.yaml). Throws
/// std::invalid_argument that lists every fault with file, line and key, or the names that exist.
Scenario load_scenario(const std::string& name_or_file, const ScenarioOverrides& overrides = {});

/// Names of the scenarios that ship with the program, sorted.
std::vector<std::string> scenario_names();

}  // namespace foretrack
