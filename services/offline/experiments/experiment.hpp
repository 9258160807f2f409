// SPDX-License-Identifier: Apache-2.0
// The experiments as data: which worlds, speeds and conditions, and what counts as an event.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foretrack {

/// First seeds of the experiments. Parameters are tuned on seeds below 1000 only.
inline constexpr std::uint64_t kFirstEvaluationSeed = 5001;
inline constexpr std::uint64_t kFirstEncounterSeed = 20001;
inline constexpr std::uint64_t kFirstHidingSeed = 31001;  // searches are tuned on 30001–30099
inline constexpr std::uint64_t kFirstFleetSeed = 51001;

/// What is counted, and judged as docs/metrics.md says.
enum class EventKind : std::uint8_t {
  kTurn,          // of the target
  kDeceleration,  // sudden stop
  kPass,          // the turn at the T-intersection (the origin)
  kWalk,          // one recorded pedestrian, followed to the end
  kEncounter,     // somebody comes near
  kHiding         // the followed person was out of reach, and comes back
};

/// What differs from the scenario; the name is empty for none.
struct Condition {
  std::string name;
  std::vector<std::string> settings;  // as in ScenarioOverrides
};

/// Runs are seeds: each is flown in each world, at each speed, in each condition, by each method.
struct Experiment {
  std::string name;
  std::string summary;
  EventKind event = EventKind::kTurn;
  std::vector<std::string> worlds;  // scenarios, by name or file
  std::vector<double> speeds_m_s;   // empty: the scenario's own
  std::vector<Condition> conditions = {Condition{}};
  double duration_s = 60.0;
  int runs = 10;       // of the whole experiment
  int quick_runs = 1;  // of the short one
  double quick_duration_s = 60.0;
  std::vector<double> quick_speeds_m_s = {};  // of the short one; empty: all
  bool apart = false;                         // not among "all"; flown by these methods
  std::vector<std::string> methods = {};      // of one that is apart; empty: ours alone
  std::uint64_t first_seed = kFirstEvaluationSeed;
};

/// All of them: turning, deceleration, t_intersection, real_tracks, stress, and those apart:
/// chests, real_tracks_chest, encounters, encounters_all_round, search and fleet.
const std::vector<Experiment>& experiments();

/// Throws std::invalid_argument that lists the names.
const Experiment& experiment_named(std::string_view name);

/// The methods compared, as files of deploy/params.
inline constexpr std::string_view kMethods[] = {"intention", "single-path", "unaware", "cv"};
/// What the others are compared with.
inline constexpr std::string_view kOurs = kMethods[0];

}  // namespace foretrack
