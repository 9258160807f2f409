// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/encounter_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLossAllowed_s = 0.5;
constexpr double kHoverAllowed_s = 2.0;

// A cell on its way, with the gaps of its encounters.
struct PooledCell {
  EncounterCell cell;
  std::vector<double> gaps_m;
};

void add(const EncounterRecord& e, PooledCell& pool) {
  EncounterCell& c = pool.cell;
  ++c.encounters;
  c.person_encounters += e.person == 0;
  pool.gaps_m.push_back(e.least_gap_m);
  if (e.contact()) {
    ++(e.person == 0 ? c.person_contacts : c.bystander_contacts);
    c.unseen_contacts += !e.seen;
  }
  if (const double floor_m = gap_floor_m(e.person_speed_m_s); floor_m > 0.0) {
    ++c.floor_judged;
    c.floor_kept += e.least_gap_m >= floor_m;
  }
  ++c.evasions[static_cast<std::size_t>(e.evasion)];
  c.view_kept += e.longest_loss_s <= kLossAllowed_s + 1e-9;
  c.evading_s += e.evading_s;
}

void add(const RunRecord& record, PooledCell& pool) {
  ++pool.cell.flights;
  pool.cell.wall_contacts += record.metrics.collisions;
  pool.cell.hovering_flights += record.longest_hover_s > kHoverAllowed_s;
  for (const EncounterRecord& e : record.encounters) add(e, pool);
}

EncounterCell finished(PooledCell& pool) {
  EncounterCell& c = pool.cell;
  c.contact_95 = wilson(c.contacts(), c.encounters);
  c.floor_95 = wilson(c.floor_kept, c.floor_judged);
  c.view_95 = wilson(c.view_kept, c.encounters);
  if (pool.gaps_m.empty()) return c;
  std::sort(pool.gaps_m.begin(), pool.gaps_m.end());
  const auto rank = [&](double q) {
    const auto k = static_cast<std::size_t>(std::ceil(q * static_cast<double>(pool.gaps_m.size())));
    return pool.gaps_m[std::max<std::size_t>(k, 1) - 1];
  };
  c.gap_min_m = rank(0.0);
  c.gap_p05_m = rank(0.05);
  c.gap_p25_m = rank(0.25);
  c.gap_p50_m = rank(0.5);
  c.gap_p75_m = rank(0.75);
  return c;
}

PooledCell& pool_of(std::vector<PooledCell>& pools, std::string_view name, const CellKey& key) {
  const auto same = [&](const PooledCell& p) {
    return p.cell.name == name && p.cell.method == key.method && p.cell.map == key.map &&
           p.cell.speed_m_s == key.target_speed_m_s;
  };
  const auto found = std::find_if(pools.begin(), pools.end(), same);
  if (found != pools.end()) return *found;
  PooledCell& pool = pools.emplace_back();
  pool.cell.name = name;
  pool.cell.method = key.method;
  pool.cell.map = key.map;
  pool.cell.speed_m_s = key.target_speed_m_s;
  return pool;
}

std::vector<EncounterCell> finished(std::vector<PooledCell>& pools) {
  std::vector<EncounterCell> cells;
  for (PooledCell& pool : pools) cells.push_back(finished(pool));
  return cells;
}

Json json_of(const Interval95& interval) {
  return {interval.low, interval.high};
}

Json json_of(const EncounterCell& c) {
  Json evasions = Json::object();
  for (std::size_t i = 0; i < kEvasionNames.size(); ++i)
    evasions[std::string(kEvasionNames[i])] = c.evasions[i];
  return {{"name", c.name},
          {"method", c.method},
          {"map", to_string(c.map)},
          {"speed_m_s", c.speed_m_s},
          {"flights", c.flights},
          {"encounters", c.encounters},
          {"person_encounters", c.person_encounters},
          {"contacts", c.contacts()},
          {"contact_95", json_of(c.contact_95)},
          {"person_contacts", c.person_contacts},
          {"bystander_contacts", c.bystander_contacts},
          {"unseen_contacts", c.unseen_contacts},
          {"wall_contacts", c.wall_contacts},
          {"gap_min_m", c.gap_min_m},
          {"gap_p05_m", c.gap_p05_m},
          {"gap_p25_m", c.gap_p25_m},
          {"gap_p50_m", c.gap_p50_m},
          {"gap_p75_m", c.gap_p75_m},
          {"floor_judged", c.floor_judged},
          {"floor_kept", c.floor_kept},
          {"floor_95", json_of(c.floor_95)},
          {"evasions", evasions},
          {"view_kept", c.view_kept},
          {"view_95", json_of(c.view_95)},
          {"evading_s", c.evading_s},
          {"hovering_flights", c.hovering_flights}};
}

Json json_of(const std::vector<EncounterCell>& cells) {
  Json list = Json::array();
  for (const EncounterCell& cell : cells) list.push_back(json_of(cell));
  return list;
}

}  // namespace

EncounterSummary summarize_encounters(const std::vector<FlightJob>& jobs,
                                      const std::vector<RunRecord>& records) {
  std::vector<PooledCell> kinds, places;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& staged = records[i].staged;
    if (!staged) continue;
    add(records[i], pool_of(kinds, to_string(staged->kind), jobs[i].cell));
    add(records[i], pool_of(places, to_string(staged->place), jobs[i].cell));
  }
  std::stable_sort(places.begin(), places.end(), [](const PooledCell& a, const PooledCell& b) {
    return a.cell.name < b.cell.name;
  });
  return {finished(kinds), finished(places)};
}

std::string encounters_json_of(const EncounterSummary& summary) {
  const Json json = {{"by_kind", json_of(summary.by_kind)},
                     {"by_place", json_of(summary.by_place)}};
  return json.dump(2) + "\n";
}

std::string encounters_csv_of(const std::vector<FlightJob>& jobs,
                              const std::vector<RunRecord>& records) {
  std::string text =
      "kind,place,method,map,speed_m_s,seed,person,begin_s,end_s,person_speed_m_s,least_gap_m,"
      "least_gap_s,seen,wall_contact,evasion,longest_loss_s,evading_s,command\n";
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& staged = records[i].staged;
    if (!staged) continue;
    const CellKey& key = jobs[i].cell;
    for (const EncounterRecord& e : records[i].encounters)
      text += fmt::format(
          "{},{},{},{},{:g},{},{},{:.2f},{:.2f},{:.2f},{:.3f},{:.2f},{:d},{:d},{},{:.2f},{:.2f},"
          "\"{}\"\n",
          to_string(staged->kind), to_string(staged->place), key.method, to_string(key.map),
          key.target_speed_m_s, *jobs[i].overrides.seed, e.person, e.begin_s, e.end_s,
          e.person_speed_m_s, e.least_gap_m, e.least_gap_s, e.seen, e.wall_contact,
          kEvasionNames[static_cast<std::size_t>(e.evasion)], e.longest_loss_s, e.evading_s,
          jobs[i].command);
  }
  return text;
}

}  // namespace foretrack
