// SPDX-License-Identifier: Apache-2.0
// A bench as files: summary.json, details.json (for the report), flights.csv, and logs.
#pragma once

#include <filesystem>

#include "services/offline/experiments/summarize.hpp"

namespace foretrack {

/// All that a bench found.
struct BenchResults {
  std::vector<FlightJob> jobs;
  std::vector<RunRecord> records;
  std::vector<CellSummary> cells;             // by experiment, condition, method, map, speed
  std::vector<CellSummary> scenes;            // the same for each world
  std::vector<Comparison> comparisons;        // of cells
  std::vector<Comparison> scene_comparisons;  // of scenes
};

/// {"cells": […], "scenes": […], "comparisons": […], "scene_comparisons": […]}; fields as in
/// docs/metrics.md. Infinite numbers are null.
std::string summary_json_of(const BenchResults& results);

/// What the report draws: distance curves, maps of relative places, reliability, path errors, the
/// worst flight of each cell from above, and the commands that fly failed flights again.
std::string details_json_of(const BenchResults& results);

/// One line a flight, with its hash and the command that flies it again.
std::string flights_csv_of(const BenchResults& results);

/// "turning/intention-known-2.0-dense_boxes-5001.csv.gz"; a pedestrian has its number at the end.
std::string log_name_of(const FlightJob& job);

/// Text compressed by gzip, without a time stamp. Throws std::runtime_error that names the file.
void write_gzip(const std::filesystem::path& file, std::string_view text);

/// Throws std::runtime_error that names the file. Makes its folder.
void write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace foretrack
