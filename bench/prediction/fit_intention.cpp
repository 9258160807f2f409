// SPDX-License-Identifier: Apache-2.0
// Fits the calibrated intention probabilities and writes core/prediction/calibration_weights.cpp.
// Usage: fit_intention RECORDED_TRACKS OUT.cpp
#include <cstdio>
#include <fstream>
#include <iostream>

#include "bench/prediction/fit_hidden.hpp"
#include "bench/prediction/fit_softmax.hpp"
#include "bench/prediction/split.hpp"
#include "bench/prediction/write_weights.hpp"

namespace foretrack::bench {
namespace {

constexpr double kRidge = 1e-4;
constexpr double kRidgeOfFew = 1e-3;  // where there are only recorded walks
constexpr int kRecordedRounds = 12;   // there are few

struct Fit {
  std::string name;
  std::string fitted_on;
  CalibrationWeights weights;
};

void append(std::vector<Window>& all, const std::vector<Window>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// The recorded turns are too few for hidden units, or for free weights.
Fit fit(const std::string& name, const std::string& source, const std::vector<Window>& windows,
        bool are_few) {
  Fit result{name, {}, fit_softmax(windows, are_few ? kRidgeOfFew : kRidge)};
  if (!are_few) result.weights = fit_hidden(windows, result.weights);
  std::array<int, kIntentionCount> counts{};
  for (const Window& w : windows) ++counts[index_of(w.label)];
  char text[300];
  std::snprintf(text, sizeof text,
                "%s; %zu windows: %d forward, %d left, %d right, %d decelerate; log-loss %.4f",
                source.c_str(), windows.size(), counts[0], counts[1], counts[2], counts[3],
                mean_log_loss(windows, result.weights));
  result.fitted_on = text;
  std::cout << name << ": " << text << '\n';
  return result;
}

template <int kFeatures>
void write_logit(std::ostream& out, const char* name, const LogitWeights<kFeatures>& w) {
  out << "    ." << name << " = {\n";
  write_row(out, "row", w.row);
  write_rows(out, "hidden", w.hidden);
  write_row(out, "hidden_bias", w.hidden_bias);
  write_row(out, "hidden_gain", w.hidden_gain);
  out << "    },\n";
}

void write_source(std::ostream& out, const std::vector<Fit>& fits) {
  out << "// Written by bench/prediction/fit_intention; do not edit.\n"
         "#include \"core/prediction/calibrate.hpp\"\n\nnamespace foretrack {\nnamespace {\n\n";
  for (const Fit& f : fits) {
    out << "// Fitted on " << f.fitted_on << ".\nconstexpr CalibrationWeights " << f.name << "{\n";
    write_logit(out, "turn", f.weights.turn);
    write_logit(out, "decelerate", f.weights.decelerate);
    out << "};\n\n";
  }
  out << "}  // namespace\n\n"
         "const CalibrationWeights& calibration_weights(bool map_known, bool body_known) {\n"
         "  if (map_known) return body_known ? kMapAndBody : kMapOnly;\n"
         "  return body_known ? kBodyOnly : kTrackOnly;\n"
         "}\n\n}  // namespace foretrack\n";
}

int run(const std::string& tracks, const std::string& out_path) {
  const PredictionParams params;
  std::vector<Window> map_and_body, map_only, body_only, track_only;
  const auto add = [&](const Episode& episode) {
    append(map_and_body, windows_of(episode, params));
    append(map_only, windows_of(without_body(episode), params));
    append(body_only, windows_of(without_map(episode), params));
  };
  for (const SimulatedWalk& walk : fitting_turns()) add(simulate_walk(walk));
  for (const SimulatedWalk& walk : fitting_stops()) add(simulate_walk(walk));
  for (const RecordedWalk& walk : recorded_walks(tracks, kRecordedRounds)) {
    if (is_held_out(walk)) continue;
    add(walk.episode);
    append(track_only, windows_of(without_map(without_body(walk.episode)), params));
  }
  if (track_only.empty()) {
    std::cerr << "fit_intention: no recorded tracks in " << tracks << '\n';
    return 1;
  }
  const std::vector<Fit> fits = {
      fit("kMapAndBody", "simulated walks and UCY zara01 pedestrians", map_and_body, false),
      fit("kMapOnly", "the same, yaw hidden", map_only, false),
      fit("kBodyOnly", "the same, map hidden", body_only, false),
      fit("kTrackOnly", "UCY zara01 pedestrians, map and yaw hidden", track_only, true)};
  std::ofstream out(out_path);
  write_source(out, fits);
  return out ? 0 : 1;
}

}  // namespace
}  // namespace foretrack::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fit_intention RECORDED_TRACKS OUT.cpp\n";
    return 2;
  }
  return foretrack::bench::run(argv[1], argv[2]);
}
