// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/fleet_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "services/offline/flight/metrics_json.hpp"

namespace foretrack {
namespace {

std::string condition_of(const FlightJob& job) {
  return job.cell.experiment.substr(job.cell.experiment.find('/') + 1);
}

FleetCell& cell_of(std::vector<FleetCell>& cells, const FlightJob& job) {
  for (FleetCell& cell : cells)
    if (cell.name == condition_of(job) && cell.method == job.cell.method &&
        cell.map == job.cell.map && cell.speed_m_s == job.cell.target_speed_m_s)
      return cell;
  FleetCell cell;
  cell.name = condition_of(job);
  cell.method = job.cell.method;
  cell.map = job.cell.map;
  cell.speed_m_s = job.cell.target_speed_m_s;
  cell.min_separation_m = std::numeric_limits<double>::infinity();
  return cells.emplace_back(cell);
}

void add(const RunRecord& record, FleetCell& c) {
  const FleetMetrics& m = *record.fleet;
  ++c.flights;
  c.union_visibility += m.union_visibility;
  c.k2_visibility += m.k2_visibility;
  c.band_share += m.band_share;
  c.mutual_occlusion += m.mutual_occlusion;
  c.separation_score += m.separation_score;
  c.bytes_per_s += m.bytes_per_s;
  for (const FleetEvent& event : m.events) {
    ++c.events;
    c.events_seen += event.longest_unseen_s <= kUnseen_s;
  }
  c.longest_unseen_s = std::max(c.longest_unseen_s, m.longest_unseen_s);
  c.min_separation_m = std::min(c.min_separation_m, m.min_separation_m);
  c.below_separation_s += m.below_separation_s;
  c.stacked_s += m.stacked_s;
  c.contacts += m.contacts;
  c.wall_contacts += m.wall_contacts;
  c.person_contacts += m.person_contacts;
}

void finish(FleetCell& c) {
  const auto n = static_cast<double>(c.flights);
  for (double* mean : {&c.union_visibility, &c.k2_visibility, &c.band_share, &c.mutual_occlusion,
                       &c.separation_score, &c.bytes_per_s})
    *mean /= n;
  c.events_95 = wilson(c.events_seen, c.events);
}

}  // namespace

std::vector<FleetCell> summarize_fleets(const std::vector<FlightJob>& jobs,
                                        const std::vector<RunRecord>& records) {
  std::vector<FleetCell> cells;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (records[i].fleet) add(records[i], cell_of(cells, jobs[i]));
  for (FleetCell& cell : cells) finish(cell);
  return cells;
}

std::string fleets_json_of(const std::vector<FleetCell>& cells) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FleetCell& c : cells)
    list.push_back({{"name", c.name},
                    {"method", c.method},
                    {"map", to_string(c.map)},
                    {"speed_m_s", c.speed_m_s},
                    {"flights", c.flights},
                    {"union_visibility", c.union_visibility},
                    {"k2_visibility", c.k2_visibility},
                    {"band_share", c.band_share},
                    {"events", c.events},
                    {"events_seen", c.events_seen},
                    {"events_95", {c.events_95.low, c.events_95.high}},
                    {"longest_unseen_s", c.longest_unseen_s},
                    {"min_separation_m", finite_json(c.min_separation_m)},
                    {"below_separation_s", c.below_separation_s},
                    {"stacked_s", c.stacked_s},
                    {"contacts", c.contacts},
                    {"wall_contacts", c.wall_contacts},
                    {"person_contacts", c.person_contacts},
                    {"mutual_occlusion", c.mutual_occlusion},
                    {"separation_score", c.separation_score},
                    {"bytes_per_s", c.bytes_per_s}});
  return list.dump(2) + "\n";
}

std::string fleets_csv_of(const std::vector<FlightJob>& jobs,
                          const std::vector<RunRecord>& records) {
  std::string text =
      "experiment,method,map,union_visibility,k2_visibility,longest_unseen_s,min_separation_m,"
      "contacts,command\n";
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!records[i].fleet) continue;
    const FleetMetrics& m = *records[i].fleet;
    text += fmt::format("{},{},{},{:.4f},{:.4f},{:.2f},{:.3f},{},\"{}\"\n", jobs[i].cell.experiment,
                        jobs[i].cell.method, to_string(jobs[i].cell.map), m.union_visibility,
                        m.k2_visibility, m.longest_unseen_s, m.min_separation_m, m.contacts,
                        jobs[i].command);
  }
  return text;
}

}  // namespace foretrack
