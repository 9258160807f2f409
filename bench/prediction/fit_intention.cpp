// SPDX-License-Identifier: Apache-2.0
// Fits the calibrated intention probabilities, all heads of the table together, and writes the
// weights of each: core/prediction/intentions/<head>_weights.cpp.
// Usage: fit_intention RECORDED_TRACKS FOLDER
#include <cctype>
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

/// Of one state of knowledge.
struct Fit {
  std::string name;
  std::string fitted_on;
  ModelWeights weights;
};

void append(std::vector<Window>& all, const std::vector<Window>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::string text_of_counts(const std::vector<Window>& windows) {
  std::string text = std::to_string(windows.size()) + " windows:";
  for (const IntentionRow& row : kIntentions) {
    const auto count = std::ranges::count(windows, index_of(row.id), &Window::label);
    text.append(" ").append(std::to_string(count)).append(" ").append(row.name);
  }
  return text;
}

// The recorded turns are too few for hidden units, or for free weights.
Fit fit(const std::string& name, const std::string& source, const std::vector<Window>& windows,
        const Heads& heads, bool are_few) {
  Fit result{name, {}, fit_softmax(windows, heads, are_few ? kRidgeOfFew : kRidge)};
  if (!are_few) result.weights = fit_hidden(windows, heads, result.weights);
  result.fitted_on = source + ";\n// " + text_of_counts(windows) + "; log-loss " +
                     std::to_string(mean_log_loss(windows, heads, result.weights));
  std::cout << name << ": " << result.fitted_on << std::endl;
  return result;
}

std::span<const double> numbers_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

// LogitWeights of a head's features.
void write_logit(std::ostream& out, const HeadWeights& w) {
  write_row(out, "row", numbers_of(w.row));
  write_matrix(out, "hidden", w.hidden);
  write_row(out, "hidden_bias", numbers_of(w.bias));
  write_row(out, "hidden_gain", numbers_of(w.gain));
}

// turn_back: kTurnBack
std::string constant_of(std::string_view name) {
  std::string constant = "k";
  bool begins = true;
  for (const char c : name) {
    if (c != '_') constant += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '_';
  }
  return constant;
}

void write_source(std::ostream& out, const IntentionHead& head, std::size_t index,
                  const std::vector<Fit>& fits) {
  const std::string name(head.name), constant = constant_of(head.name);
  out << "// SPDX-License-Identifier: Apache-2.0\n"
         "// Written by bench/prediction/fit_intention; do not edit.\n"
         "#include \"core/prediction/intentions/"
      << name << ".hpp\"\n\nnamespace foretrack::intentions {\nnamespace {\n\n";
  for (const Fit& f : fits) {
    out << "// Fitted on " << f.fitted_on << ".\nconstexpr LogitWeights<" << head.features << "> "
        << constant << f.name << "{\n";
    write_logit(out, f.weights[index]);
    out << "};\n\n";
  }
  out << "}  // namespace\n\nLogitView " << name
      << "_weights(bool map_known, bool body_known) {\n"
         "  if (map_known) return LogitView(body_known ? "
      << constant << "MapAndBody : " << constant
      << "MapOnly);\n"
         "  return LogitView(body_known ? "
      << constant << "BodyOnly : " << constant
      << "TrackOnly);\n"
         "}\n\n}  // namespace foretrack::intentions\n";
}

/// What is known of the same walks.
struct Knowledge {
  std::vector<Window> map_and_body, map_only, body_only, track_only;

  void add(const Episode& episode) {
    const PredictionParams params;
    append(map_and_body, windows_of(episode, params));
    append(map_only, windows_of(without_body(episode), params));
    append(body_only, windows_of(without_map(episode), params));
  }
  void add_track(const Episode& episode) {
    append(track_only, windows_of(without_map(without_body(episode)), PredictionParams{}));
  }
};

int run(const std::string& tracks, const std::string& folder) {
  const Heads heads = heads_of(kIntentions);
  Knowledge known;
  for (const auto& walks : {fitting_turns(), fitting_stops(), fitting_returns()})
    for (const SimulatedWalk& walk : walks) known.add(simulate_walk(walk));
  for (const RecordedWalk& walk : recorded_walks(tracks, kRecordedRounds)) {
    if (is_held_out(walk)) continue;
    known.add(walk.episode);
    known.add_track(walk.episode);
  }
  if (known.track_only.empty()) {
    std::cerr << "fit_intention: no recorded tracks in " << tracks << '\n';
    return 1;
  }
  const std::vector<Fit> fits = {
      fit("MapAndBody", "simulated walks and UCY zara01 pedestrians", known.map_and_body, heads,
          false),
      fit("MapOnly", "the same, yaw hidden", known.map_only, heads, false),
      fit("BodyOnly", "the same, map hidden", known.body_only, heads, false),
      fit("TrackOnly", "UCY zara01 pedestrians, map and yaw hidden", known.track_only, heads,
          true)};
  for (std::size_t h = 0; h < heads.heads.size(); ++h) {
    std::ofstream out(folder + "/" + std::string(heads.heads[h]->name) + "_weights.cpp");
    write_source(out, *heads.heads[h], h, fits);
    if (!out) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace foretrack::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fit_intention RECORDED_TRACKS FOLDER\n";
    return 2;
  }
  return foretrack::bench::run(argv[1], argv[2]);
}
