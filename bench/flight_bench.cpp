// SPDX-License-Identifier: Apache-2.0
// Many lock-step flights of one scenario, a seed each, and their metrics together.
//   flight_bench --scenario street_blocks --seeds 20 --speed 2.0 --params tuned.yaml
// The seed also sets the generated world, unless --same-world. One line a flight, then the totals.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/offline/flight/fly.hpp"

namespace {

using namespace foretrack;

struct Options {
  std::string scenario = "street_blocks", params;
  int first = 1, seeds = 10;
  double speed_m_s = 0.0;
  bool same_world = false;
  ScenarioOverrides overrides;
};

struct Totals {
  double time_s = 0.0, failure_s = 0.0, out_of_view_s = 0.0, occluded_s = 0.0, near_s = 0.0,
         band_s = 0.0, smoothness = 0.0, lead_s = 0.0;
  int turns = 0, successes = 0, collisions = 0, foreseen = 0;

  void add(const Metrics& m) {
    time_s += m.duration_s;
    failure_s += m.failure_rate * m.duration_s;
    out_of_view_s += m.fov_loss_rate * m.duration_s;
    occluded_s += m.occlusion_rate * m.duration_s;
    near_s += m.near_rate * m.duration_s;
    band_s += m.band_share * m.duration_s;
    smoothness += m.smoothness_m2_s5 * m.duration_s;
    lead_s += m.lead_time_median_s * m.turns;
    turns += m.turns;
    successes += m.turn_successes;
    collisions += m.collisions;
    foreseen += m.foreseen;
  }
};

void print_flight(std::uint64_t seed, const Metrics& m) {
  std::printf("%5llu  %6.2f  %6.2f  %6.2f  %6.2f   %2d/%-2d  %6.2f  %5.2f  %5.2f  %3d   %6.2f\n",
              static_cast<unsigned long long>(seed), 100.0 * m.failure_rate,
              100.0 * m.fov_loss_rate, 100.0 * m.occlusion_rate, 100.0 * m.near_rate,
              m.turn_successes, m.turns, 100.0 * m.band_share, m.min_distance_m, m.longest_loss_s,
              m.collisions, m.plan_ms.p50);
  std::fflush(stdout);
}

void print_totals(const Totals& t) {
  const Interval95 interval = wilson(t.successes, t.turns);
  std::printf("failure rate %.2f %% (out of view %.2f, occluded %.2f, near %.2f), band %.1f %%\n",
              100.0 * t.failure_s / t.time_s, 100.0 * t.out_of_view_s / t.time_s,
              100.0 * t.occluded_s / t.time_s, 100.0 * t.near_s / t.time_s,
              100.0 * t.band_s / t.time_s);
  std::printf("turns %d/%d = %.1f %% (95 %%: %.1f to %.1f), collisions %d in %.0f s\n", t.successes,
              t.turns, t.turns ? 100.0 * t.successes / t.turns : 0.0, 100.0 * interval.low,
              100.0 * interval.high, t.collisions, t.time_s);
  std::printf("foreseen %d/%d, mean of median leads %.2f s, jerk² %.2f m²/s⁵\n", t.foreseen,
              t.turns, t.turns ? t.lead_s / t.turns : 0.0, t.smoothness / t.time_s);
}

int run(Options o) {
  const TrackerParams params = o.params.empty() ? TrackerParams{} : load_params(o.params);
  Totals totals;
  std::printf(
      " seed   fail%%   view%%   occl%%   near%%   turns   band%%   dmin   loss  hit  plan ms\n");
  for (int i = 0; i < o.seeds; ++i) {
    o.overrides.seed = static_cast<std::uint64_t>(o.first + i);
    Scenario scenario = load_scenario(o.scenario, o.overrides);
    if (!o.same_world) scenario.generator.seed = *o.overrides.seed;
    if (o.speed_m_s > 0.0) scenario.target.speed_m_s = o.speed_m_s;
    const FlightResult flight = fly(scenario, params);
    print_flight(*o.overrides.seed, flight.metrics);
    totals.add(flight.metrics);
  }
  print_totals(totals);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  bool depth = false;
  CLI::App app("many flights of one scenario");
  app.add_option("--scenario", o.scenario)->capture_default_str();
  app.add_option("--params", o.params)->check(CLI::ExistingFile);
  app.add_option("--seeds", o.seeds, "how many flights")->capture_default_str();
  app.add_option("--first", o.first, "the first seed")->capture_default_str();
  app.add_option("--speed", o.speed_m_s, "of the target, m/s");
  app.add_option("--for", o.overrides.duration_s, "seconds a flight");
  app.add_flag("--depth", depth, "build the map from depth images");
  app.add_flag("--same-world", o.same_world, "the scenario's own generator seed");
  CLI11_PARSE(app, argc, argv);
  if (depth) o.overrides.map = MapSource::kDepth;
  try {
    return run(o);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
