// SPDX-License-Identifier: Apache-2.0
// What a scenario file says, before the files that it names are read and anything is drawn.
#pragma once

#include <optional>
#include <string>

#include "core/simulator/scenario.hpp"
#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {

struct TrackSource {
  std::string file;
  int format = 0;
  int pedestrian = 1;
  double rate_hz = 0.0;  // 0: as the file says, else 25
  Vec2 offset_m = Vec2::Zero();
};

// Stops drawn from the scenario's seed: the walks between them, and how long they last.
struct RandomStops {
  Vec2 every_s = Vec2::Zero();
  Vec2 for_s = Vec2(1.0, 3.0);
};

struct ScenarioFile {
  Scenario scenario;
  std::optional<TrackSource> track;
  std::optional<RandomStops> random_stops;
  std::string octree;
  std::optional<EncounterKind> encounter;  // stages world, walks and vehicle
  std::optional<HidingKind> hiding;        // stages world, walk and duration
  bool generator_has_seed = false, has_bounds = false, has_resolution = false;
  bool has_shoulder_lead = false;
};

/// Faults go to the reader's.
ScenarioFile read_scenario_file(YamlReader& r);

}  // namespace foretrack
