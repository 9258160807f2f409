// SPDX-License-Identifier: Apache-2.0
// What the pose network makes of rendered people, and flights that see by it.
//   camera_bench [--walks N] [--hidden N] [--crossings N] [--flights N] [--first SEED] [--params
//   FILE] [--json]
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/camera/crossings.hpp"
#include "bench/run_bench.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/files/share/share.hpp"
#include "services/offline/flight/fly.hpp"
#include "services/offline/people/load_person.hpp"

namespace {

using namespace foretrack;
using Json = nlohmann::ordered_json;

struct Options {
  int walks = 16, hidden = 6, flights = 0, crossings = 0;
  std::uint64_t first = 1;
  double seconds = 8.0;
  std::string params, scenario = "t_intersection";
  bool json = false;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double share_of(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : std::nan("");
}

Json json_of(const PoseErrors& e) {
  return {{"horizontal_m", {quantile(e.horizontal_m, 0.5), quantile(e.horizontal_m, 0.95)}},
          {"range_bias_m", quantile(e.range_m, 0.5)},
          {"horizontal_filtered_m", quantile(e.horizontal_filtered_m, 0.5)},
          {"yaw_deg", {deg(quantile(e.yaw_rad, 0.5)), deg(quantile(e.yaw_rad, 0.95))}},
          {"yaw_filtered_deg", deg(quantile(e.yaw_filtered_rad, 0.5))}};
}

Json json_of(const WalkScores& s) {
  return {{"frames", s.frames},
          {"frames_in_view", s.in_view},
          {"detected", share_of(s.detected, s.in_view)},
          {"partly_in_view", s.partly},
          {"detected_partly", share_of(s.detected_partly, s.partly)},
          {"by_height", json_of(s.by_height)},
          {"by_depth", json_of(s.by_depth)},
          {"hidden_frames", s.hidden},
          {"hidden_without_pose", 1.0 - share_of(s.false_poses, s.hidden)},
          {"appearances", s.appearances},
          {"found_again_s", {quantile(s.found_again_s, 0.5), quantile(s.found_again_s, 1.0)}},
          {"network_ms", s.network_ms / s.frames},
          {"render_ms", s.render_ms / s.frames}};
}

Json run_walks(const Options& o, const PerceptionParams& params) {
  PoseNetwork network =
      load_pose_network(find_share("models"), static_cast<PoseModel>(params.model_complexity));
  constexpr std::array kHeights_m = {1.60, 1.75, 1.90};
  constexpr std::array kDistances_m = {2.0, 3.0, 4.0, 5.0};
  const auto people = person_names();
  const auto walk_of = [&](int i) {
    return WalkCase{o.first + static_cast<std::uint64_t>(i), people[i % people.size()],
                    kHeights_m[i % kHeights_m.size()],
                    kDistances_m[(i / 4 + i) % kDistances_m.size()], o.seconds};
  };
  WalkScores total;
  for (int i = 0; i < o.walks; ++i) {
    WalkScores own;
    const WalkCase w = walk_of(i);
    run_walk(w, network, params, own);
    total.add(own);
    if (!o.json)
      std::printf(
          "%-5s %.2f m tall, %.0f m away: %3d of %3d, %.3f m (range %+.3f), yaw %.1f°, "
          "with depth %.3f m (%+.3f)\n",
          w.person.c_str(), w.height_m, w.distance_m, own.detected + own.detected_partly,
          own.in_view + own.partly, quantile(own.by_height.horizontal_m, 0.5),
          quantile(own.by_height.range_m, 0.5), deg(quantile(own.by_height.yaw_rad, 0.5)),
          quantile(own.by_depth.horizontal_m, 0.5), quantile(own.by_depth.range_m, 0.5));
    std::fflush(stdout);
  }
  for (int i = 0; i < o.hidden; ++i) {
    WalkCase walk = walk_of(i);
    walk.distance_m = std::max(walk.distance_m, 3.0);
    walk.seconds = 12.0;
    run_hidden_walk(walk, network, params, total);
  }
  return json_of(total);
}

Json json_of(const CrossingScores& s) {
  return {{"encounters", s.encounters},
          {"switches", s.switches},
          {"said", s.said},
          {"astray", s.astray},
          {"lost_at_end", s.lost_at_end},
          {"found", share_of(s.found, s.frames)},
          {"refused", share_of(s.refused, s.found)},
          {"of_other", share_of(s.of_other, s.found)},
          {"near", share_of(s.near_frames, s.frames)},
          {"ambiguous", share_of(s.ambiguous, s.frames)},
          {"network_ms", s.network_ms / s.frames}};
}

// So many of each kind.
Json run_crossings(const Options& o, const PerceptionParams& params) {
  PoseNetwork network =
      load_pose_network(find_share("models"), static_cast<PoseModel>(params.model_complexity));
  const auto people = person_names();
  Json report;
  CrossingScores total;
  for (std::size_t kind = 0; kind < kCrossingNames.size(); ++kind) {
    CrossingScores own;
    for (int i = 0; i < o.crossings; ++i) {
      const std::uint64_t seed = o.first + static_cast<std::uint64_t>(i);
      const auto draw = static_cast<int>(seed % 12);
      const WalkCase walk{seed, people[seed % people.size()], 1.65 + 0.1 * (draw % 3),
                          2.0 + 0.75 * (draw / 2 % 4), o.seconds};
      const int before = own.switches;
      run_crossing(walk, static_cast<Crossing>(kind), network, params, own);
      if (!o.json && own.switches > before)
        std::printf("%s, seed %d: switched\n", std::string(kCrossingNames[kind]).c_str(),
                    static_cast<int>(walk.seed));
      std::fflush(stdout);
    }
    report[std::string(kCrossingNames[kind])] = json_of(own);
    total.add(own);
  }
  report["all"] = json_of(total);
  return report;
}

// A flight succeeds if nothing is hit and the person is not lost for good: every turn stays in
// view.
Json run_flights(const Options& o, const TrackerParams& params) {
  Json flights = Json::array();
  int successes = 0;
  for (int i = 0; i < o.flights; ++i) {
    ScenarioOverrides overrides;
    overrides.seed = o.first + static_cast<std::uint64_t>(i);
    overrides.color_images = true;
    const Scenario scenario = load_scenario(o.scenario, overrides);
    const Metrics m = fly(scenario, params).metrics;
    const bool success = m.collisions == 0 && m.turns > 0 && m.turn_successes == m.turns;
    successes += success;
    flights.push_back({{"seed", *overrides.seed},
                       {"success", success},
                       {"failure_rate", m.failure_rate},
                       {"turns", m.turns},
                       {"turn_successes", m.turn_successes},
                       {"longest_loss_s", m.longest_loss_s},
                       {"collisions", m.collisions}});
    if (!o.json) std::printf("%s\n", flights.back().dump().c_str());
    std::fflush(stdout);
  }
  return {{"flights", flights}, {"successes", successes}};
}

int run(const Options& o) {
  const TrackerParams params = o.params.empty() ? TrackerParams{} : load_params(o.params);
  Json report;
  if (o.walks > 0 || o.hidden > 0) report["walks"] = run_walks(o, params.perception);
  if (o.crossings > 0) report["crossings"] = run_crossings(o, params.perception);
  if (o.flights > 0) report["closed_loop"] = run_flights(o, params);
  std::printf("%s\n", report.dump(1).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("rendered people through the pose network, and flights that see by it");
  app.add_option("--walks", o.walks, "walks in the open")->capture_default_str();
  app.add_option("--hidden", o.hidden, "walks behind a wall")->capture_default_str();
  app.add_option("--seconds", o.seconds, "of each walk")->capture_default_str();
  app.add_option("--crossings", o.crossings, "encounters with somebody else, of each kind")
      ->capture_default_str();
  app.add_option("--flights", o.flights, "closed-loop flights")->capture_default_str();
  app.add_option("--scenario", o.scenario, "of the flights")->capture_default_str();
  app.add_option("--first", o.first, "first seed")->capture_default_str();
  app.add_option("--params", o.params)->check(CLI::ExistingFile);
  app.add_flag("--json", o.json, "only the report");
  return run_bench(app, argc, argv, [&] { return run(o); });
}
