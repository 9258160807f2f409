// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/hiding_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace foretrack {
namespace {

struct Span {
  double from_s, to_s;
};
constexpr std::array<Span, 3> kSpans = {{{2.0, 5.0}, {5.0, 12.0}, {12.0, 1e9}}};
constexpr double kShownEnd_s = 20.0;

struct PooledHidings {
  HidingCell cell;
  std::vector<double> until_found_s;
};

std::string kind_of(const FlightJob& job) {
  return job.cell.experiment.substr(job.cell.experiment.find('/') + 1);
}

PooledHidings& pool_of(std::vector<PooledHidings>& pools, const std::string& name,
                       const FlightJob& job, const Span& span) {
  for (PooledHidings& pool : pools)
    if (pool.cell.name == name && pool.cell.method == job.cell.method &&
        pool.cell.map == job.cell.map && pool.cell.hidden_from_s == span.from_s)
      return pool;
  HidingCell cell;
  cell.name = name;
  cell.method = job.cell.method;
  cell.map = job.cell.map;
  cell.hidden_from_s = span.from_s;
  cell.hidden_to_s = std::min(span.to_s, kShownEnd_s);
  cell.least_gap_m = std::numeric_limits<double>::infinity();
  return pools.emplace_back(PooledHidings{cell, {}});
}

void add(const HidingRecord& hiding, int wall_contacts, PooledHidings& pool) {
  HidingCell& c = pool.cell;
  ++c.hidings;
  c.found += hiding.found_within(kFindWithin_s);
  c.contacts += hiding.least_gap_m <= 0.0;
  c.wall_contacts += wall_contacts;
  c.least_gap_m = std::min(c.least_gap_m, hiding.least_gap_m);
  pool.until_found_s.push_back(hiding.until_found_s());
}

double quantile(std::vector<double>& values, double share) {
  const auto i = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(i, 1) - 1];
}

HidingCell finished(PooledHidings& pool) {
  HidingCell& c = pool.cell;
  std::ranges::sort(pool.until_found_s);
  c.found_95 = wilson(c.found, c.hidings);
  c.until_found_p50_s = quantile(pool.until_found_s, 0.5);
  c.until_found_p90_s = quantile(pool.until_found_s, 0.9);
  return c;
}

nlohmann::json time_or_null(double time_s) {
  return std::isfinite(time_s) ? nlohmann::json(time_s) : nlohmann::json(nullptr);
}

}  // namespace

std::vector<HidingCell> summarize_hidings(const std::vector<FlightJob>& jobs,
                                          const std::vector<RunRecord>& records) {
  std::vector<PooledHidings> pools;
  for (const bool all : {false, true})
    for (const Span& span : kSpans)
      for (std::size_t i = 0; i < jobs.size(); ++i)
        for (const HidingRecord& hiding : records[i].hidings)
          if (hiding.hidden_s() >= span.from_s && hiding.hidden_s() < span.to_s)
            add(hiding, records[i].metrics.collisions,
                pool_of(pools, all ? "all" : kind_of(jobs[i]), jobs[i], span));
  std::ranges::stable_sort(pools, [](const PooledHidings& a, const PooledHidings& b) {
    return (a.cell.name == "all") < (b.cell.name == "all");
  });
  std::vector<HidingCell> cells;
  for (PooledHidings& pool : pools) cells.push_back(finished(pool));
  return cells;
}

std::string hidings_json_of(const std::vector<HidingCell>& cells) {
  nlohmann::json list = nlohmann::json::array();
  for (const HidingCell& c : cells)
    list.push_back({{"name", c.name},
                    {"method", c.method},
                    {"map", to_string(c.map)},
                    {"hidden_from_s", c.hidden_from_s},
                    {"hidden_to_s", c.hidden_to_s},
                    {"hidings", c.hidings},
                    {"found", c.found},
                    {"found_95", {c.found_95.low, c.found_95.high}},
                    {"until_found_p50_s", time_or_null(c.until_found_p50_s)},
                    {"until_found_p90_s", time_or_null(c.until_found_p90_s)},
                    {"contacts", c.contacts},
                    {"wall_contacts", c.wall_contacts},
                    {"least_gap_m", c.least_gap_m}});
  return list.dump(2) + "\n";
}

std::string hidings_csv_of(const std::vector<FlightJob>& jobs,
                           const std::vector<RunRecord>& records) {
  std::string text =
      "experiment,method,map,hidden_s,reappears_s,until_found_s,least_gap_m,command\n";
  for (std::size_t i = 0; i < jobs.size(); ++i)
    for (const HidingRecord& h : records[i].hidings)
      text += fmt::format("{},{},{},{:.2f},{:.2f},{:.2f},{:.3f},\"{}\"\n", jobs[i].cell.experiment,
                          jobs[i].cell.method, to_string(jobs[i].cell.map), h.hidden_s(),
                          h.reappears_s, h.until_found_s(), h.least_gap_m, jobs[i].command);
  return text;
}

}  // namespace foretrack
