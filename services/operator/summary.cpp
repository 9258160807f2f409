// SPDX-License-Identifier: Apache-2.0
#include "services/operator/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "services/offline/flight/metrics_json.hpp"

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string row(const char* name, const std::string& value, const std::string& remark = "") {
  return fmt::format("  {:<20}{:>12}   {}\n", name, value, remark);
}

std::string tracking(const Metrics& m) {
  std::string text;
  text += row("failure rate", percent(m.failure_rate),
              fmt::format("out of view {}, hidden {}, too near {}", percent(m.fov_loss_rate),
                          percent(m.occlusion_rate), percent(m.near_rate)));
  text += row("distance", fmt::format("{:.2f} m", m.mean_distance_m),
              fmt::format("mean; smallest {:.2f} m; in the band {}", m.min_distance_m,
                          percent(m.band_share)));
  text += row("longest loss", fmt::format("{:.1f} s", m.longest_loss_s),
              fmt::format("{} losses of sight", m.losses));
  text += row("turns kept", fmt::format("{} of {}", m.turn_successes, m.turns),
              "in sight and at distance, without a collision");
  text += row("collisions", std::to_string(m.collisions),
              std::isfinite(m.min_clearance_m)
                  ? fmt::format("smallest clearance {:.2f} m", m.min_clearance_m)
                  : "nothing to collide with");
  text +=
      row("intention", fmt::format("{} of {}", m.foreseen, m.turns),
          fmt::format("turns foreseen, {:.2f} s {} at the median", std::abs(m.lead_time_median_s),
                      m.lead_time_median_s < 0.0 ? "late" : "ahead"));
  return text;
}

std::string times(const FlightSummary& s) {
  std::string text =
      fmt::format("\n  {:<20}{:>9}{:>9}{:>9}{:>9}\n", "wall time [ms]", "p50", "p95", "p99", "max");
  const auto line = [&](const std::string& name, const Quantiles& q) {
    text +=
        fmt::format("  {:<20}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}\n", name, q.p50, q.p95, q.p99, q.max);
  };
  for (const auto& [name, quantiles] : s.stage_ms) line(name, quantiles);
  if (s.wall_latency_ms.p50 > 0.0) line("image to setpoint", s.wall_latency_ms);
  line(s.wall_latency_ms.p50 > 0.0 ? "  by the flight's clock" : "image to setpoint", s.latency_ms);
  const double camera_ms = s.camera_delay_ms;
  if (camera_ms > 0.0)
    line("  after the camera", {.p50 = s.latency_ms.p50 - camera_ms,
                                .p95 = s.latency_ms.p95 - camera_ms,
                                .p99 = s.latency_ms.p99 - camera_ms,
                                .max = s.latency_ms.max - camera_ms});
  return text;
}

std::string services(const FlightSummary& s) {
  std::string text =
      fmt::format("\n  {:<20}{:>12}{:>12}{:>12}\n", "service", "processor", "memory", "restarts");
  const auto line = [&](const std::string& name, const ServiceSummary& of) {
    text += fmt::format("  {:<20}{:>10.1f} %{:>9.1f} MB{:>12}\n", name, of.cpu_percent,
                        of.memory_bytes / 1e6, of.restarts);
  };
  for (const auto& [name, of] : s.services) line(name, of);
  line("onboard together", s.onboard);
  return text;
}

Json json_of(const ServiceSummary& s) {
  return {
      {"cpu_percent", s.cpu_percent}, {"memory_bytes", s.memory_bytes}, {"restarts", s.restarts}};
}

}  // namespace

FlightSummary summarize(const FlightLog& log, const MetricParams& params) {
  FlightSummary summary;
  summary.path_length_m = log.path_length_m();
  summary.plans = log.plans();
  if (!log.rows().empty()) summary.metrics = metrics_of(log.rows(), params);
  for (const auto& [name, values] : log.stage_ms()) summary.stage_ms[name] = quantiles_of(values);
  summary.latency_ms = quantiles_of(log.latency_ms());
  summary.wall_latency_ms = quantiles_of(log.wall_latency_ms());
  if (summary.stage_ms.contains("plan")) summary.metrics.plan_ms = summary.stage_ms.at("plan");
  return summary;
}

std::string to_text(const FlightSummary& s) {
  std::string text = fmt::format("\nFlight of {}: {:.1f} s, {:.1f} m flown, {} plans\n\n",
                                 s.scenario, s.metrics.duration_s, s.path_length_m, s.plans);
  if (s.wall_s > 1.2 * s.metrics.duration_s)
    text += fmt::format("  It took {:.1f} s here: {:.2f} of real time.\n\n", s.wall_s,
                        s.metrics.duration_s / s.wall_s);
  return text + tracking(s.metrics) + times(s) + services(s);
}

std::string to_json_text(const FlightSummary& s) {
  Json json = {{"scenario", s.scenario},
               {"vehicle", s.vehicle},
               {"domain", s.domain},
               {"happened", s.happened()},
               {"good", s.good()},
               {"wall_s", s.wall_s},
               {"path_length_m", s.path_length_m},
               {"plans", s.plans},
               {"metrics", Json::parse(foretrack::json_of(s.metrics))},
               {"latency_ms", json_of(s.latency_ms)},
               {"wall_latency_ms", json_of(s.wall_latency_ms)},
               {"camera_delay_ms", s.camera_delay_ms}};
  for (const auto& [name, quantiles] : s.stage_ms) json["stage_ms"][name] = json_of(quantiles);
  for (const auto& [name, of] : s.services) json["services"][name] = json_of(of);
  json["onboard"] = json_of(s.onboard);
  return json.dump(2) + '\n';
}

}  // namespace foretrack
