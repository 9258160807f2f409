// SPDX-License-Identifier: Apache-2.0
// People who walk, as they really went and as a noisy tracker saw them: what prediction is fitted
// and measured on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/common/grid_map.hpp"
#include "core/common/target.hpp"
#include "core/scores/truth.hpp"
#include "core/simulator/generate_world.hpp"

namespace foretrack::bench {

inline constexpr double kTruthStep_s = 0.02;
inline constexpr int kTruthPerEstimate = 2;  // estimates come at 25 Hz

/// estimates[i] is of the time of truth.samples[kTruthPerEstimate · i].
struct Episode {
  std::string name;
  GridMap map;  // empty: not known
  Truth truth{.step_s = kTruthStep_s, .samples = {}};
  std::vector<TargetState> estimates;
};

/// As if the map, or the body's yaw, were not known.
Episode without_map(Episode episode);
Episode without_body(Episode episode);

/// Where somebody's chest points: as in PersonParams and LandmarkCameraParams.
struct Chest {
  std::optional<double> lead_s = {};  // none: 0.2 to 0.4 s, by the walk's seed
  double offset_rad = 0.0;
  double sway_rad = 0.0, sway_hz = 0.5;
  double flip_share = 0.0;
};

struct SimulatedWalk {
  bool in_passages = false;  // else in a world of this kind
  WorldKind kind = WorldKind::kEmpty;
  std::uint64_t seed = 1;
  double speed_m_s = 1.5;
  int stops = 0;                // sudden ones, without a cause in the surroundings
  double return_every_m = 0.0;  // turns round so often, and some metres later again; 0: never
  bool returns_at_end = false;  // goes to and fro before the end of a passage
  double duration_s = 60.0;
  Chest chest = {};
};

/// Sharp turns around what stands in a generated world, shoulders ahead of the path.
Episode simulate_walk(const SimulatedWalk& walk);

/// Passages and every kind of world at 1.0, 1.5 and 2.0 m/s, `rounds` times, from worlds of this
/// seed on.
std::vector<SimulatedWalk> turning_walks(std::uint64_t first_seed, int rounds);

/// Walks in open worlds with a sudden stop every few seconds, `rounds` times.
std::vector<SimulatedWalk> stopping_walks(std::uint64_t first_seed, int rounds);

/// Passages and open worlds in which who walks turns back now and then, in several manners, and
/// ends of passages, some of them dead ends, at which they always do; `rounds` times.
std::vector<SimulatedWalk> returning_walks(std::uint64_t first_seed, int rounds);

/// Recorded pedestrians of a file in OpenTraj's format, on free ground; the chest, which was not
/// recorded, turns ahead of the path as a simulated person's. Each is seen `rounds` times, with
/// other noise. Empty if there is no such file.
struct RecordedWalk {
  int pedestrian = 0;
  Episode episode;
};
std::vector<RecordedWalk> recorded_walks(const std::string& path, int rounds);

}  // namespace foretrack::bench
