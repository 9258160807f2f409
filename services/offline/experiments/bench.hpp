// SPDX-License-Identifier: Apache-2.0
// foretrack bench: flies experiments, and writes what they showed.
#pragma once

#include <filesystem>

#include "services/offline/experiments/run_jobs.hpp"
#include "services/offline/experiments/write_results.hpp"

namespace foretrack {

enum class KeptLogs : std::uint8_t { kNone, kFailed, kAll };
inline constexpr std::array<std::string_view, 3> kKeptLogsNames = {"none", "failed", "all"};

struct BenchOptions {
  int threads = 0;                 // 0: one a core
  std::filesystem::path out = {};  // empty: nothing is written
  KeptLogs logs = KeptLogs::kFailed;
  std::function<void(const BenchProgress&)> progress = {};
  std::function<bool()> stopped = {};  // once true: what was flown until then is summed up
};

/// Flies all of it and sums it up; with a folder, writes summary.json, details.json, flights.csv
/// and logs/ there. Throws std::invalid_argument for a request that cannot be, before any flight.
BenchResults run_bench(const BenchRequest& request, const BenchOptions& options = {});

/// Draws report.html and plots/*.png from the folder's files with deploy/plot/bench_report.py.
/// Throws std::runtime_error that says what is missing (Python 3 with matplotlib and jinja2).
void write_report(const std::filesystem::path& folder, const std::string& command);

}  // namespace foretrack
