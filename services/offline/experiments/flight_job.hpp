// SPDX-License-Identifier: Apache-2.0
// One flight of an experiment, and the cells that its result counts in.
#pragma once

#include <string>
#include <vector>

#include "services/files/config/load_scenario.hpp"
#include "services/offline/experiments/experiment.hpp"

namespace foretrack {

/// What a bench is asked for.
struct BenchRequest {
  std::vector<Experiment> experiments;
  std::vector<std::string> methods;  // names in deploy/params, or parameter files
  std::vector<MapSource> maps = {MapSource::kKnown, MapSource::kDepth};
  std::vector<std::string> scenario_files;  // fly these instead of the experiments' worlds
  std::vector<std::string> track_files;     // pedestrians of real_tracks; none: the shipped ones
  double track_rate_hz = 0.0;               // 0: as the files say, else 25
  std::vector<double> speeds_m_s;           // instead of the experiments'
  std::uint64_t seed = 0;                   // the first; 0: the experiments'
  int runs = 0;                             // instead of the experiments'; 0: theirs
  bool quick = false;
};

/// Results with the same key are pooled.
struct CellKey {
  std::string experiment;  // with the condition, if there is one: stress/delay_s=0.1
  std::string method;
  MapSource map = MapSource::kKnown;
  double target_speed_m_s = 0.0;  // 0: the scenario's own
  bool operator==(const CellKey&) const = default;
};

struct FlightJob {
  CellKey cell;
  EventKind event = EventKind::kTurn;
  std::string world;  // the scenario's name or file
  ScenarioOverrides overrides;
  std::string params;   // a file
  std::string command;  // flies it again
  int pair = 0;         // flights of different methods with the same pair are comparable
};

/// Every flight, cell by cell. Throws std::invalid_argument for unknown methods, bad scenario files
/// and track files: before anything is flown.
std::vector<FlightJob> list_jobs(const BenchRequest& request);

}  // namespace foretrack
