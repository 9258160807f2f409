// SPDX-License-Identifier: Apache-2.0
// From records of flights to cells, and to comparisons between methods.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "services/offline/experiments/encounter_summary.hpp"
#include "services/offline/experiments/fleet_summary.hpp"
#include "services/offline/experiments/hiding_summary.hpp"
#include "services/offline/experiments/run_record.hpp"
#include "services/offline/experiments/statistics.hpp"

namespace foretrack {

/// The flights of one cell, pooled: rates over their common time, least distances, all events.
struct CellSummary {
  CellKey key;
  EventKind event = EventKind::kTurn;
  std::string world;              // empty: all
  std::vector<std::size_t> runs;  // indices of jobs and records
  int events = 0, successes = 0, collisions = 0;
  Interval95 success_95;
  double duration_s = 0.0, target_speed_m_s = 0.0;
  double failure_rate = 0.0, occlusion_rate = 0.0, fov_loss_rate = 0.0, near_rate = 0.0;
  double band_share = 0.0, min_distance_m = 0.0, min_clearance_m = 0.0;
  double near_event_share = 0.0;  // of events with a distance below 1 m
  Quantiles plan_ms;
  std::uint64_t seed = 0;  // the first
  std::string log_sha256;  // of the flights' hashes, a line each
  RelativePlaces places;
  IntentionReport intention;
  PathScorer paths;
  std::size_t worst_run = 0;  // most events failed, then the greatest failure rate
};

/// In the order of the jobs. by_world: one for each world of each cell.
std::vector<CellSummary> summarize(const std::vector<FlightJob>& jobs,
                                   const std::vector<RunRecord>& records, bool by_world = false);

/// Ours against another method, on the same seeds.
struct Comparison {
  CellKey key;  // of the other
  std::string world;
  int pairs = 0, only_ours = 0, only_theirs = 0;  // events of which one alone succeeded
  double p = 1.0;                                 // McNemar, exact
  MeanInterval failure_difference;                // theirs − ours, over flights
  double failure_ours = 0.0, failure_theirs = 0.0;
  bool significant() const { return p < 0.05; }
};
std::vector<Comparison> compare(const std::vector<FlightJob>& jobs,
                                const std::vector<RunRecord>& records,
                                const std::vector<CellSummary>& cells);

/// All that a bench found.
struct BenchResults {
  std::vector<FlightJob> jobs;
  std::vector<RunRecord> records;
  std::vector<CellSummary> cells;             // by experiment, condition, method, map, speed
  std::vector<CellSummary> scenes;            // the same for each world
  std::vector<Comparison> comparisons;        // of cells
  std::vector<Comparison> scene_comparisons;  // of scenes
  EncounterSummary encounters;
  std::vector<HidingCell> hidings;
  std::vector<FleetCell> fleets;
};

}  // namespace foretrack
