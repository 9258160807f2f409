// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/summarize.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace foretrack {
namespace {

using Jobs = std::vector<FlightJob>;
using Records = std::vector<RunRecord>;

constexpr double kNear_m = 1.0;

int failures_of(const RunRecord& r) {
  return static_cast<int>(
      std::count_if(r.events.begin(), r.events.end(), [](const auto& e) { return !e.success; }));
}

bool is_worse(const RunRecord& a, const RunRecord& b) {
  if (a.metrics.collisions != b.metrics.collisions)
    return a.metrics.collisions > b.metrics.collisions;
  if (failures_of(a) != failures_of(b)) return failures_of(a) > failures_of(b);
  return a.metrics.failure_rate > b.metrics.failure_rate;
}

void add_events(const RunRecord& r, CellSummary& cell) {
  for (const EventOutcome& event : r.events) {
    ++cell.events;
    cell.successes += event.success;
    cell.near_event_share += event.min_distance_m < kNear_m;
  }
}

void add_rates(const RunRecord& r, CellSummary& cell) {
  const Metrics& m = r.metrics;
  const double t = m.duration_s;
  cell.duration_s += t;
  cell.target_speed_m_s += t * r.mean_speed_m_s;
  cell.failure_rate += t * m.failure_rate;
  cell.occlusion_rate += t * m.occlusion_rate;
  cell.fov_loss_rate += t * m.fov_loss_rate;
  cell.near_rate += t * m.near_rate;
  cell.band_share += t * m.band_share;
  cell.collisions += m.collisions;
  cell.min_distance_m = std::min(cell.min_distance_m, m.min_distance_m);
  cell.min_clearance_m = std::min(cell.min_clearance_m, m.min_clearance_m);
}

void finish(CellSummary& cell) {
  for (double* rate : {&cell.failure_rate, &cell.occlusion_rate, &cell.fov_loss_rate,
                       &cell.near_rate, &cell.band_share, &cell.target_speed_m_s})
    *rate /= std::max(cell.duration_s, 1e-9);
  if (cell.key.target_speed_m_s > 0.0) cell.target_speed_m_s = cell.key.target_speed_m_s;
  cell.near_event_share /= std::max(cell.events, 1);
  cell.success_95 = wilson(cell.successes, cell.events);
}

void pool(const Jobs& jobs, const Records& records, CellSummary& cell) {
  cell.min_distance_m = cell.min_clearance_m = std::numeric_limits<double>::infinity();
  cell.seed = *jobs[cell.runs.front()].overrides.seed;
  cell.worst_run = cell.runs.front();
  std::string hashes;
  std::vector<double> plan_ms;
  IntentionScorer intentions;
  for (const std::size_t i : cell.runs) {
    const RunRecord& r = records[i];
    add_events(r, cell);
    add_rates(r, cell);
    hashes += r.log_sha256 + "\n";
    plan_ms.insert(plan_ms.end(), r.plan_ms.begin(), r.plan_ms.end());
    cell.places += r.places;
    cell.paths += r.paths;
    intentions += r.intentions;
    if (is_worse(r, records[cell.worst_run])) cell.worst_run = i;
  }
  finish(cell);
  cell.plan_ms = quantiles_of(std::move(plan_ms));
  cell.log_sha256 = sha256_of(hashes);
  cell.intention = intentions.report();
}

// The flights of our method that have a pair in the other cell.
std::vector<std::pair<const RunRecord*, const RunRecord*>> pairs_of(const Jobs& jobs,
                                                                    const Records& records,
                                                                    const CellSummary& theirs) {
  std::map<int, const RunRecord*> ours;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].cell.method == kOurs) ours[jobs[i].pair] = &records[i];
  std::vector<std::pair<const RunRecord*, const RunRecord*>> pairs;
  for (const std::size_t i : theirs.runs)
    if (const auto found = ours.find(jobs[i].pair); found != ours.end())
      pairs.emplace_back(found->second, &records[i]);
  return pairs;
}

}  // namespace

std::vector<CellSummary> summarize(const Jobs& jobs, const Records& records, bool by_world) {
  std::vector<CellSummary> cells;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string world = by_world ? jobs[i].world : std::string();
    const auto same = [&](const CellSummary& c) {
      return c.key == jobs[i].cell && c.world == world;
    };
    auto cell = std::find_if(cells.begin(), cells.end(), same);
    if (cell == cells.end()) {
      cells.emplace_back();
      cell = cells.end() - 1;
      cell->key = jobs[i].cell;
      cell->event = jobs[i].event;
      cell->world = world;
    }
    cell->runs.push_back(i);
  }
  for (CellSummary& cell : cells) pool(jobs, records, cell);
  return cells;
}

std::vector<Comparison> compare(const Jobs& jobs, const Records& records,
                                const std::vector<CellSummary>& cells) {
  std::vector<Comparison> all;
  for (const CellSummary& cell : cells) {
    if (cell.key.method == kOurs) continue;
    const auto pairs = pairs_of(jobs, records, cell);
    if (pairs.empty()) continue;
    Comparison c;
    c.key = cell.key;
    c.world = cell.world;
    std::vector<double> differences;
    for (const auto& [ours, theirs] : pairs) {
      differences.push_back(theirs->metrics.failure_rate - ours->metrics.failure_rate);
      c.failure_ours += ours->metrics.failure_rate / static_cast<double>(pairs.size());
      c.failure_theirs += theirs->metrics.failure_rate / static_cast<double>(pairs.size());
      // The target walks the same way whoever follows: the events are the same ones.
      const std::size_t n = std::min(ours->events.size(), theirs->events.size());
      for (std::size_t k = 0; k < n; ++k) {
        ++c.pairs;
        c.only_ours += ours->events[k].success && !theirs->events[k].success;
        c.only_theirs += theirs->events[k].success && !ours->events[k].success;
      }
    }
    c.p = mcnemar_p(c.only_ours, c.only_theirs);
    c.failure_difference = bootstrap_mean(differences, cell.seed);
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace foretrack
