// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/details_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kCurvesShown = 12;    // single ones, the nearest first
constexpr std::size_t kCommandsShown = 10;  // of a cell

float nearest_of(const DistanceCurve& curve) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const float d : curve)
    if (d < nearest) nearest = d;
  return nearest;
}

Json json_of(const DistanceCurve& curve) {
  Json json = Json::array();
  for (const float d : curve)
    json.push_back(std::isfinite(d) ? Json(std::round(1000.0 * d) / 1000.0) : Json(nullptr));
  return json;
}

// Quantiles at each time over all events, and the curves that came nearest.
Json curves_of(const BenchResults& r, const CellSummary& cell) {
  std::vector<const DistanceCurve*> curves;
  for (const std::size_t i : cell.runs)
    for (const auto& curve : r.records[i].curves) curves.push_back(&curve);
  Json json = {{"from_s", kCurveFrom_s}, {"step_s", kCurveStep_s}, {"count", curves.size()}};
  if (curves.empty()) return json;
  std::array<DistanceCurve, 3> bands;
  for (std::size_t k = 0; k < curves.front()->size(); ++k) {
    std::vector<float> values;
    for (const auto* curve : curves)
      if (std::isfinite((*curve)[k])) values.push_back((*curve)[k]);
    std::sort(values.begin(), values.end());
    constexpr std::array<double, 3> quantiles = {0.05, 0.5, 0.95};
    for (std::size_t b = 0; b < bands.size(); ++b)
      bands[b].push_back(
          values.empty()
              ? std::numeric_limits<float>::quiet_NaN()
              : values[static_cast<std::size_t>(quantiles[b] * double(values.size() - 1))]);
  }
  json["p05"] = json_of(bands[0]);
  json["p50"] = json_of(bands[1]);
  json["p95"] = json_of(bands[2]);
  std::stable_sort(curves.begin(), curves.end(),
                   [](auto* a, auto* b) { return nearest_of(*a) < nearest_of(*b); });
  json["nearest"] = Json::array();
  for (std::size_t i = 0; i < std::min(kCurvesShown, curves.size()); ++i)
    json["nearest"].push_back(json_of(*curves[i]));
  return json;
}

Json json_of(const RelativePlaces& p) {
  const double n = std::max(p.count, 1.0), mx = p.x / n, my = p.y / n;
  return {{"cell_m", RelativePlaces::kCell_m},
          {"min_m", {RelativePlaces::kMinX_m, RelativePlaces::kMinY_m}},
          {"cells_per_side", RelativePlaces::kCells},
          {"cells", p.cells},
          {"mean_m", {mx, my}},
          {"covariance_m2", {p.xx / n - mx * mx, p.xy / n - mx * my, p.yy / n - my * my}},
          {"ellipse_90_area_m2", p.ellipse_area_m2()}};
}

Json json_of(const AnnouncementReport& a) {
  return {{"events", a.events},
          {"by_onset", a.by_onset},
          {"median_lead_s", a.median_lead_s},
          {"false_alarms_per_min", a.false_alarms_per_min}};
}

Json json_of(const IntentionReport& q) {
  Json bins = Json::array();
  for (const auto& b : q.reliability) bins.push_back({b.probability, b.frequency, b.count});
  return {{"windows", q.windows},
          {"brier", q.brier},
          {"base_brier", q.base_brier},
          {"brier_skill", q.brier_skill()},
          {"log_loss", q.log_loss},
          {"base_log_loss", q.base_log_loss},
          {"ece", q.ece},
          {"turns", json_of(q.turns)},
          {"either_turn", json_of(q.either_turn)},
          {"stops", json_of(q.stops)},
          {"bins", bins}};
}

Json json_of(const PathTable& table) {
  Json rows = Json::array();
  for (std::size_t kind = 0; kind < table.size(); ++kind)
    for (std::size_t h = 0; h < table[kind].size(); ++h) {
      const PathErrors& e = table[kind][h];
      rows.push_back({{"path", kPathKindNames[kind]},
                      {"horizon_s", kPathHorizons_s[h]},
                      {"windows", e.count},
                      {"ade_m", e.ade_m},
                      {"fde_m", e.fde_m},
                      {"brier_fde_m", e.brier_fde_m},
                      {"missed_half_m", e.missed_half_m},
                      {"missed_one_m", e.missed_one_m}});
    }
  return rows;
}

Json world_json(const World& world) {
  Json boxes = Json::array(), cylinders = Json::array();
  for (const Box& b : world.boxes)
    boxes.push_back({b.min_m.x(), b.min_m.y(), b.max_m.x(), b.max_m.y()});
  for (const Cylinder& c : world.cylinders)
    cylinders.push_back({c.center_m.x(), c.center_m.y(), c.radius_m});
  return {{"boxes", boxes}, {"cylinders", cylinders}};
}

Json worst_of(const BenchResults& r, const CellSummary& cell) {
  const FlightJob& job = r.jobs[cell.worst_run];
  const RunRecord& record = r.records[cell.worst_run];
  Json view = Json::array(), events = Json::array();
  const auto rounded = [](float v) { return std::round(1000.0 * v) / 1000.0; };
  for (const ViewPoint& p : record.view)
    view.push_back({rounded(p.time_s), rounded(p.vehicle_m[0]), rounded(p.vehicle_m[1]),
                    rounded(p.target_m[0]), rounded(p.target_m[1]), p.visible ? 1 : 0});
  for (const EventOutcome& e : record.events) events.push_back({e.begin_s, e.success});
  return {{"world", job.world},
          {"seed", *job.overrides.seed},
          {"failure_rate", record.metrics.failure_rate},
          {"collisions", record.metrics.collisions},
          {"command", job.command},
          {"shapes", world_json(world_of(load_scenario(job.world, job.overrides)))},
          {"view", view},
          {"events", events}};
}

Json commands_of(const BenchResults& r, const CellSummary& cell) {
  Json commands = Json::array();
  for (const std::size_t i : cell.runs)
    if (r.records[i].failed() && commands.size() < kCommandsShown)
      commands.push_back(r.jobs[i].command);
  return commands;
}

Json json_of(const BenchResults& r, const CellSummary& cell) {
  const auto failed = std::count_if(cell.runs.begin(), cell.runs.end(),
                                    [&](std::size_t i) { return r.records[i].failed(); });
  return {{"experiment", cell.key.experiment},
          {"method", cell.key.method},
          {"map", to_string(cell.key.map)},
          {"target_speed_m_s", cell.target_speed_m_s},
          {"flights", cell.runs.size()},
          {"flights_failed", failed},
          {"near_event_share", cell.near_event_share},
          {"places", json_of(cell.places)},
          {"curves", curves_of(r, cell)},
          {"intention", json_of(cell.intention)},
          {"paths", json_of(cell.paths.means(PathWindows::kAll))},
          {"paths_turning", json_of(cell.paths.means(PathWindows::kTurning))},
          {"paths_straight", json_of(cell.paths.means(PathWindows::kStraight))},
          {"worst", worst_of(r, cell)},
          {"failed_commands", commands_of(r, cell)}};
}

}  // namespace

std::string details_json_of(const BenchResults& r) {
  Json cells = Json::array();
  for (const CellSummary& cell : r.cells) cells.push_back(json_of(r, cell));
  return Json{{"cells", std::move(cells)}}.dump() + "\n";
}

}  // namespace foretrack
