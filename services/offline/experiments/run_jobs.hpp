// SPDX-License-Identifier: Apache-2.0
// All flights of an experiment, on all cores.
#pragma once

#include <functional>
#include <vector>

#include "services/offline/experiments/run_record.hpp"

namespace foretrack {

/// What is known of a bench on its way.
struct BenchProgress {
  std::size_t done = 0;
  std::size_t total = 0;
  double elapsed_s = 0.0;
  double left_s = 0.0;  // weighed by what the flights have to compute
};

/// Is given every flight's log as it ends; called from several threads at once.
using LogSink = std::function<void(const FlightJob&, const RunRecord&, const std::string& log_csv)>;

/// Flies one job.
RunRecord run_job(const FlightJob& job, const LogSink& sink = {});

/// Records in the order of the jobs, whatever the number of threads (0: one a core): the same
/// records but for plan_ms. show is called from one thread at a time. The first error of a flight
/// ends the bench and is thrown, with the command that flies it again. Once stopped() holds, no
/// further flight begins, and jobs keeps only those that were flown.
std::vector<RunRecord> run_jobs(std::vector<FlightJob>& jobs, int threads,
                                const std::function<void(const BenchProgress&)>& show = {},
                                const LogSink& sink = {},
                                const std::function<bool()>& stopped = {});

}  // namespace foretrack
