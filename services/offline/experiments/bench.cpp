// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/bench.hpp"

#include <stdexcept>

#include "services/files/share/share.hpp"
#include "services/offline/experiments/details_json.hpp"
#include "services/offline/experiments/summary_json.hpp"
#include "services/offline/flight/run_program.hpp"

namespace foretrack {

BenchResults run_bench(const BenchRequest& request, const BenchOptions& options) {
  BenchResults r;
  r.jobs = list_jobs(request);
  if (r.jobs.empty()) throw std::invalid_argument("bench: there is nothing to fly");
  LogSink keep;
  if (!options.out.empty() && options.logs != KeptLogs::kNone)
    keep = [&options](const FlightJob& job, const RunRecord& record, const std::string& log) {
      if (options.logs == KeptLogs::kAll || record.failed())
        write_gzip(options.out / "logs" / log_name_of(job), log);
    };
  r.records = run_jobs(r.jobs, options.threads, options.progress, keep, options.stopped);
  if (r.jobs.empty()) throw std::runtime_error("bench: stopped before a flight had ended");
  r.cells = summarize(r.jobs, r.records);
  r.scenes = summarize(r.jobs, r.records, true);
  r.comparisons = compare(r.jobs, r.records, r.cells);
  r.scene_comparisons = compare(r.jobs, r.records, r.scenes);
  r.encounters = summarize_encounters(r.jobs, r.records);
  r.hidings = summarize_hidings(r.jobs, r.records);
  r.fleets = summarize_fleets(r.jobs, r.records);
  if (options.out.empty()) return r;
  write_text(options.out / "summary.json", summary_json_of(r));
  write_text(options.out / "details.json", details_json_of(r));
  write_text(options.out / "flights.csv", flights_csv_of(r));
  if (!r.hidings.empty()) {
    write_text(options.out / "hidings.json", hidings_json_of(r.hidings));
    write_text(options.out / "hidings.csv", hidings_csv_of(r.jobs, r.records));
  }
  if (!r.fleets.empty()) {
    write_text(options.out / "fleets.json", fleets_json_of(r.fleets));
    write_text(options.out / "fleets.csv", fleets_csv_of(r.jobs, r.records));
  }
  if (r.encounters.empty()) return r;
  write_text(options.out / "encounters.json", encounters_json_of(r.encounters));
  write_text(options.out / "encounters.csv", encounters_csv_of(r.jobs, r.records));
  return r;
}

void write_report(const std::filesystem::path& folder, const std::string& command) {
  const auto script = find_share("deploy/plot/bench_report.py");
  const int status = run_program({"/usr/bin/python3", script.string(), folder.string(), command});
  if (status == 0) return;
  if (status == 3)
    throw std::runtime_error(
        "report.html needs matplotlib and jinja2: install python3-matplotlib and python3-jinja2 "
        "(the other files are written)");
  throw std::runtime_error("report.html could not be made: /usr/bin/python3 " + script.string() +
                           " ended with " + std::to_string(status));
}

}  // namespace foretrack
