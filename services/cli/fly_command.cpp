// SPDX-License-Identifier: Apache-2.0
// foretrack fly: one lock-step flight into a folder.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "core/prediction/calibrate.hpp"
#include "services/cli/commands.hpp"
#include "services/cli/scenario_options.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/offline/flight/metrics_json.hpp"
#include "services/offline/flight/write_fleet.hpp"
#include "services/offline/flight/write_flight.hpp"

namespace foretrack {
namespace {

struct FlyOptions {
  std::string scenario = "t_intersection";
  std::string map;
  std::string params;
  std::string out;
  ScenarioOverrides overrides;
  bool json = false;
  bool plot = true;
};

FlightOptions with_progress_line(double duration_s) {
  FlightOptions options;
  if (!isatty(STDERR_FILENO)) return options;
  options.progress = [duration_s, shown_s = 0.0](double now_s) mutable {
    if (now_s < shown_s) return true;
    shown_s = now_s + 1.0;
    fmt::print(stderr, "\rflying {:.0f} of {:.0f} s ", now_s, duration_s);
    std::fflush(stderr);
    return true;
  };
  return options;
}

void print_summary(const Metrics& m, const std::string& hash, const std::string& out) {
  fmt::print("failure rate      {:6.2f} %  (out of view {:.2f}, occluded {:.2f}, near {:.2f})\n",
             100.0 * m.failure_rate, 100.0 * m.fov_loss_rate, 100.0 * m.occlusion_rate,
             100.0 * m.near_rate);
  fmt::print("turns             {} of {}  (95 % interval {:.0f} … {:.0f} %)\n", m.turn_successes,
             m.turns, 100.0 * m.turn_success_95.low, 100.0 * m.turn_success_95.high);
  fmt::print("distance          {:6.2f} m mean, {:.2f} m least, in the band {:.0f} % of the time\n",
             m.mean_distance_m, m.min_distance_m, 100.0 * m.band_share);
  fmt::print("longest loss      {:6.2f} s, {} losses\n", m.longest_loss_s, m.losses);
  fmt::print("collisions        {}  (least clearance {:.2f} m)\n", m.collisions, m.min_clearance_m);
  fmt::print("turns foreseen    {}  ({:.2f} s ahead; {:.1f} false alarms a minute)\n", m.foreseen,
             m.lead_time_median_s, m.false_alarms_per_min);
  fmt::print("replan            {:6.2f} ms median, {:.2f} ms P99\n", m.plan_ms.p50, m.plan_ms.p99);
  if (!out.empty()) fmt::print("written to        {}\n", out);
  fmt::print("log SHA-256       {}\n", hash);
}

void name_unfitted() {
  for (const std::string_view name : unfitted())
    fmt::print(stderr, "{} has no fitted head: its probability is 0\n", name);
}

int fly_fleet_with(const FlyOptions& o, const Scenario& scenario, const TrackerParams& params) {
  const FleetFlight flight = fly_fleet(scenario, params, with_progress_line(scenario.duration_s));
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r{:40}\r", "");
  if (!o.out.empty()) write_fleet_flight(flight, metric_params_of(params), o.out);
  if (o.json)
    fmt::print("{}", json_of(flight));
  else
    fmt::print("{}", to_text(flight));
  return 0;
}

int fly_with(const FlyOptions& o) {
  name_unfitted();
  const Scenario scenario = load_scenario(o.scenario, o.overrides);
  const TrackerParams params =
      o.params.empty() ? TrackerParams{} : load_params(find_params(o.params));
  if (!scenario.vehicles.empty()) return fly_fleet_with(o, scenario, params);
  const FlightResult flight = fly(scenario, params, with_progress_line(scenario.duration_s));
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r{:40}\r", "");
  std::string hash;
  if (o.out.empty()) {
    hash = sha256_of(csv_of(flight.rows));
  } else {
    hash = write_flight(flight, metric_params_of(params), o.out);
    if (o.plot) plot_flight(o.out);
  }
  if (o.json)
    fmt::print("{}", json_of(flight.metrics, hash));
  else
    print_summary(flight.metrics, hash, o.out);
  return 0;
}

}  // namespace

std::function<int()> prepare_fly(CLI::App& app) {
  const auto o = std::make_shared<FlyOptions>();
  app.add_option("--scenario", o->scenario, "a shipped name or a YAML file")->capture_default_str();
  app.add_option("--seed", o->overrides.seed, "instead of the scenario's");
  app.add_option("--map", o->map, "where the map comes from")
      ->check(CLI::IsMember({"known", "depth"}));
  app.add_option("--params", o->params, "parameter file, or the name of a shipped one");
  add_settings(app, o->overrides);
  add_vehicles(app, o->overrides);
  app.add_option("--track", o->overrides.track_file, "walk as a recorded pedestrian of this file")
      ->check(CLI::ExistingFile);
  app.add_option("--pedestrian", o->overrides.pedestrian, "which one of the track file");
  app.add_option("--track-rate", o->overrides.track_rate_hz,
                 "frames a second of the track file; missing: as it says, else 25")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_flag("--camera", o->overrides.color_images,
               "see rendered images through the pose network");
  app.add_option("--for", o->overrides.duration_s, "seconds to fly")->check(CLI::PositiveNumber);
  app.add_option("--out", o->out, "folder for log.csv, metrics.json and flight.png");
  app.add_flag("--json", o->json, "print the metrics as JSON");
  app.add_flag("!--no-plot", o->plot, "leave flight.png out");
  return [o] {
    if (!o->map.empty())
      o->overrides.map = o->map == "depth" ? MapSource::kDepth : MapSource::kKnown;
    return fly_with(*o);
  };
}

}  // namespace foretrack
