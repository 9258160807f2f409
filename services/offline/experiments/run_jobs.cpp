// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/run_jobs.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "services/common/time_now.hpp"
#include "services/files/config/load_params.hpp"
#include "services/offline/flight/fly_fleet.hpp"

namespace foretrack {
namespace {

constexpr double kDepthCost = 10.0;  // of a flight that builds its map, against one that knows it

double cost_of(const FlightJob& job) {
  return job.overrides.duration_s.value_or(60.0) *
         (job.overrides.map == MapSource::kDepth ? kDepthCost : 1.0);
}

// Threads take the next job from here and put its record in its place.
class Pool {
 public:
  Pool(std::vector<FlightJob>& jobs, const std::function<void(const BenchProgress&)>& show,
       const LogSink& sink, const std::function<bool()>& stopped)
      : jobs_(jobs), show_(show), sink_(sink), stopped_(stopped), records_(jobs.size()) {
    for (const FlightJob& job : jobs) cost_total_ += cost_of(job);
  }

  std::vector<RunRecord> run(int threads) {
    {
      std::vector<std::jthread> workers;
      for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work(); });
    }
    if (!error_.empty()) throw std::runtime_error(error_);
    std::vector<FlightJob> flown;
    std::vector<RunRecord> records;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!records_[i]) continue;
      flown.push_back(std::move(jobs_[i]));
      records.push_back(std::move(*records_[i]));
    }
    jobs_ = std::move(flown);
    return records;
  }

 private:
  void work() {
    for (std::size_t i = next_++; i < jobs_.size() && !ends(); i = next_++) {
      try {
        records_[i] = run_job(jobs_[i], sink_);
        report(jobs_[i]);
      } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        failed_ = true;
        if (error_.empty()) error_ = jobs_[i].command + "\n  " + error.what();
      }
    }
  }

  bool ends() const { return failed_ || (stopped_ && stopped_()); }

  void report(const FlightJob& job) {
    const std::lock_guard lock(mutex_);
    ++done_;
    cost_done_ += cost_of(job);
    const double elapsed_s = steady_s() - begin_s_;
    if (show_)
      show_({done_, jobs_.size(), elapsed_s, elapsed_s * (cost_total_ / cost_done_ - 1.0)});
  }

  std::vector<FlightJob>& jobs_;
  const std::function<void(const BenchProgress&)>& show_;
  const LogSink& sink_;
  const std::function<bool()>& stopped_;
  std::vector<std::optional<RunRecord>> records_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::string error_;
  std::size_t done_ = 0;
  double cost_total_ = 0.0, cost_done_ = 0.0;
  double begin_s_ = steady_s();
};

}  // namespace

namespace {

RunRecord run_fleet(const FlightJob& job, const Scenario& scenario, const TrackerParams& params,
                    const LogSink& sink) {
  const FleetFlight flight = fly_fleet(scenario, params);
  const std::string log = csv_of(flight.vehicles.front().rows);
  RunRecord record =
      record_of(flight.vehicles.front(), log, {}, job.event, metric_params_of(params));
  record.fleet = flight.metrics;
  if (sink) sink(job, record, log);
  return record;
}

}  // namespace

RunRecord run_job(const FlightJob& job, const LogSink& sink) {
  const TrackerParams params = load_params(job.params);
  const Scenario scenario = load_scenario(job.world, job.overrides);
  if (!scenario.vehicles.empty()) return run_fleet(job, scenario, params, sink);
  PathRecord paths;
  const FlightResult flight = fly(scenario, params, {}, [&](const TrackerOutput& out) {
    if (out.planned) paths.add(out.target, out.prediction->prediction);
  });
  const std::string log = csv_of(flight.rows);
  RunRecord record = record_of(flight, log, paths, job.event, metric_params_of(params));
  if (sink) sink(job, record, log);
  return record;
}

std::vector<RunRecord> run_jobs(std::vector<FlightJob>& jobs, int threads,
                                const std::function<void(const BenchProgress&)>& show,
                                const LogSink& sink, const std::function<bool()>& stopped) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return Pool(jobs, show, sink, stopped)
      .run(std::min(threads, std::max(1, static_cast<int>(jobs.size()))));
}

}  // namespace foretrack
