// SPDX-License-Identifier: Apache-2.0
// Measures prediction on held-out walks, simulated and recorded; or, to tune by, on such walks as
// the intentions were fitted on.
// Usage: predict_bench [--tracks FILE] [--json FILE] [--training]
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/prediction/split.hpp"
#include "core/prediction/predict.hpp"
#include "core/scores/score_intentions.hpp"
#include "core/scores/score_paths.hpp"

namespace foretrack::bench {
namespace {

using Json = nlohmann::json;

struct Score {
  IntentionScorer intention;
  PathScorer paths;
  PathScorer true_paths;  // from the state that an estimate can only near
  std::vector<double> times_us;
  std::array<int, 4> statuses{};
};

void run_episode(const Episode& episode, Score& score) {
  constexpr int kJudgedEvery = 5;  // estimates: 0.2 s
  const PredictionParams params;
  PredictionState state;
  HeadingRate heading_rate;
  std::vector<SaidIntention> said;
  for (int k = 0; k < static_cast<int>(episode.estimates.size()); ++k) {
    const TargetState& target = episode.estimates[k];
    const double time_s = k * kTruthPerEstimate * kTruthStep_s;
    const auto start = std::chrono::steady_clock::now();
    const PredictionResult& result = predict(state, target, episode.map, params);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    score.times_us.push_back(took.count());
    ++score.statuses[static_cast<int>(result.prediction.status)];
    const double rate_rad_s = heading_rate.next(time_s, target.velocity_enu_m_s.head<2>());
    if (k % kJudgedEvery == 0) {
      score.paths.add(target, rate_rad_s, result.prediction, episode.truth, time_s);
      const TruthSample& truth = episode.truth.samples[k * kTruthPerEstimate];
      TargetState true_state = target;
      true_state.position_enu_m.head<2>() = truth.position_m;
      true_state.velocity_enu_m_s.head<2>() = truth.velocity_m_s;
      score.true_paths.add(true_state, 0.0, result.prediction, episode.truth, time_s);
    }
    said.push_back({time_s, {}});
    for (int i = 0; i < kIntentionCount; ++i)
      said.back().p[i] = result.intention.beliefs[i].probability;
  }
  score.intention.add(said, episode.truth);
}

// What is printed and written: all kinds, and constant velocity had the state been known.
using PathRows =
    std::vector<std::pair<std::string, std::array<PathErrors, kPathHorizons_s.size()>>>;
PathRows rows_of(const Score& score, PathWindows windows) {
  PathRows rows;
  const PathTable table = score.paths.means(windows);
  for (std::size_t m = 0; m < table.size(); ++m) rows.emplace_back(kPathKindNames[m], table[m]);
  rows.emplace_back(
      "of the true state",
      score.true_paths.means(windows)[static_cast<std::size_t>(PathKind::kConstantVelocity)]);
  return rows;
}

void print_paths(PathWindows windows, const Score& score) {
  const PathRows rows = rows_of(score, windows);
  std::printf(
      "\n%s windows (n = %d at 3 s): FDE [m] / ADE / brier-FDE / missed by 0.5 m / by 1 m\n",
      kPathWindowNames[static_cast<std::size_t>(windows)].data(), rows[0].second.back().count);
  for (const auto& [name, errors] : rows) {
    std::printf("  %-19s", name.c_str());
    for (std::size_t h = 0; h < kPathHorizons_s.size(); ++h) {
      const PathErrors& e = errors[h];
      std::printf(" | %.1f s: %.2f %.2f %.2f %2.0f%% %2.0f%%", kPathHorizons_s[h], e.fde_m, e.ade_m,
                  e.brier_fde_m, 100.0 * e.missed_half_m, 100.0 * e.missed_one_m);
    }
    std::printf("\n");
  }
}

void print_announcements(const char* name, const AnnouncementReport& r) {
  std::printf(
      "%s: %d, announced by their onset %.0f%%, median lead %.2f s; false alarms %.2f a minute\n",
      name, r.events, 100.0 * r.by_onset / std::max(1, r.events), r.median_lead_s,
      r.false_alarms_per_min);
}

void print_intention(const char* name, const IntentionReport& r) {
  std::printf("\n== %s: %.1f min, %d windows, base rates", name, r.walked_min, r.windows);
  for (int i = 0; i < kIntentionCount; ++i)
    std::printf(" %s %.3f", kIntentions[i].name.data(), r.base_rate[i]);
  std::printf("\nBrier %.4f, skill %.3f; log-loss %.4f (base %.4f); ECE %.4f, of turns %.4f\n",
              r.brier, r.brier_skill(), r.log_loss, r.base_log_loss, r.ece, r.ece_turn);
  print_announcements("turns", r.turns);
  print_announcements("turns, either side", r.either_turn);
  print_announcements("stops", r.stops);
}

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Json json_of(const std::vector<ReliabilityBin>& bins) {
  Json rows = Json::array();
  for (const auto& b : bins) rows.push_back({b.probability, b.frequency, b.count});
  return rows;
}

Json json_of(const PathRows& paths) {
  Json rows = Json::array();
  for (const auto& [name, errors] : paths)
    for (std::size_t h = 0; h < kPathHorizons_s.size(); ++h) {
      const PathErrors& e = errors[h];
      rows.push_back({{"path", name},
                      {"horizon_s", kPathHorizons_s[h]},
                      {"windows", e.count},
                      {"fde_m", e.fde_m},
                      {"ade_m", e.ade_m},
                      {"brier_fde_m", e.brier_fde_m},
                      {"missed_half_m", e.missed_half_m},
                      {"missed_one_m", e.missed_one_m}});
    }
  return rows;
}

Json json_of(const AnnouncementReport& r) {
  return {{"events", r.events},
          {"by_onset", r.by_onset},
          {"median_lead_s", r.median_lead_s},
          {"leads_s", r.leads_s},
          {"false_alarms_per_min", r.false_alarms_per_min}};
}

Json json_of(const IntentionReport& r) {
  return {{"windows", r.windows},
          {"base_rate", r.base_rate},
          {"brier", r.brier},
          {"brier_skill", r.brier_skill()},
          {"log_loss", r.log_loss},
          {"base_log_loss", r.base_log_loss},
          {"ece", r.ece},
          {"ece_turn", r.ece_turn},
          {"reliability", json_of(r.reliability)},
          {"turn_reliability", json_of(r.turn_reliability)},
          {"turns", json_of(r.turns)},
          {"either_turn", json_of(r.either_turn)},
          {"stops", json_of(r.stops)},
          {"walked_min", r.walked_min}};
}

Json report(const char* name, Score& score) {
  const IntentionReport intention = score.intention.report();
  print_intention(name, intention);
  Json json = {{"intention", json_of(intention)}};
  for (const PathWindows windows :
       {PathWindows::kTurning, PathWindows::kStraight, PathWindows::kAll}) {
    print_paths(windows, score);
    json[std::string(kPathWindowNames[static_cast<std::size_t>(windows)])] =
        json_of(rows_of(score, windows));
  }
  const double p50 = quantile(score.times_us, 0.5), p99 = quantile(score.times_us, 0.99);
  std::printf("\npredict(): %zu calls, P50 %.0f us, P99 %.0f us; ok %d, blocked %d, exhausted %d\n",
              score.times_us.size(), p50, p99, score.statuses[0], score.statuses[2],
              score.statuses[3]);
  json["predict_p50_us"] = p50;
  json["predict_p99_us"] = p99;
  return json;
}

int run(const std::string& tracks, const std::string& json_path, bool training) {
  Json out;
  Score passages, open_worlds, sudden_stops, recorded, with_body;
  std::printf("%s\n", training ? "Training walks" : "Held-out walks");
  for (const SimulatedWalk& walk : training ? fitting_turns() : held_out_turns())
    run_episode(simulate_walk(walk), walk.in_passages ? passages : open_worlds);
  for (const SimulatedWalk& walk : training ? fitting_stops() : held_out_stops())
    run_episode(simulate_walk(walk), sudden_stops);
  out["passages"] = report("Simulated passages", passages);
  out["open_worlds"] = report("Simulated open worlds", open_worlds);
  out["sudden_stops"] = report("Open worlds with sudden stops", sudden_stops);
  for (const RecordedWalk& walk : recorded_walks(tracks, 3))
    if (is_held_out(walk) != training) {
      run_episode(without_map(without_body(walk.episode)), recorded);
      run_episode(walk.episode, with_body);
    }
  if (recorded.times_us.empty())
    std::printf("\nno recorded tracks at '%s': skipped\n", tracks.c_str());
  else {
    out["recorded"] = report("Recorded pedestrians: the track alone", recorded);
    out["recorded_with_body"] = report("The same, free ground and a chest that leads", with_body);
  }
  if (json_path.empty()) return 0;
  std::ofstream file(json_path);
  file << out.dump(1) << '\n';
  return file ? 0 : 1;
}

}  // namespace
}  // namespace foretrack::bench

int main(int argc, char** argv) {
  std::string tracks = "../shared/data/ucy_zara01_obsmat.txt", json;
  bool training = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--training") == 0) {
      training = true;
      continue;
    }
    std::string* value = std::strcmp(argv[i], "--tracks") == 0 ? &tracks
                         : std::strcmp(argv[i], "--json") == 0 ? &json
                                                               : nullptr;
    if (value == nullptr || i + 1 == argc) {
      std::cerr << "usage: predict_bench [--tracks FILE] [--json FILE] [--training]\n";
      return 2;
    }
    *value = argv[++i];
  }
  return foretrack::bench::run(tracks, json, training);
}
