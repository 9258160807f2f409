// SPDX-License-Identifier: Apache-2.0
// Fits what the last moments tell of the next ones and writes
// core/prediction/short_term_weights.cpp. Fit the intentions again afterwards: they are assessed of
// the motion that this tells. Usage: fit_motion RECORDED_TRACKS OUT.cpp
#include <fstream>
#include <iostream>

#include "bench/prediction/fit_network.hpp"
#include "bench/prediction/split.hpp"
#include "bench/prediction/write_weights.hpp"

namespace foretrack::bench {
namespace {

constexpr int kRecordedRounds = 12;  // there are few
constexpr int kEvery = 3;            // estimates
constexpr int kFirst = 18;           // before it, there is hardly a past

void add_samples(const Episode& episode, std::vector<ShortTermSample>& samples) {
  const Truth& truth = episode.truth;
  const int soon = truth.steps(ShortTermMotion::kSoon_s);
  MotionHistory history;
  for (int k = 0; k < static_cast<int>(episode.estimates.size()); ++k) {
    const TargetState& target = episode.estimates[k];
    const int i = k * kTruthPerEstimate;
    if (i + soon >= truth.count()) return;
    const PlanarState measured{target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>()};
    remember(history, {target.stamp_s, measured, target.body_yaw_rad});
    if (k < kFirst || k % kEvery != 0) continue;
    ShortTermSample& sample = samples.emplace_back();
    sample.features = short_term_features(history, target);
    const Eigen::Rotation2Dd to_heading(-sample.features.heading_rad);
    const auto error = [&](const TruthSample& at, double ahead_s, Vec2& position, Vec2& velocity) {
      const PlanarState said = advance(MotionModel::constant_velocity(), measured, ahead_s);
      position = to_heading * (at.position_m - said.position_m);
      velocity = to_heading * (at.velocity_m_s - said.velocity_m_s);
    };
    error(truth.samples[i], 0.0, sample.errors[0], sample.errors[1]);
    error(truth.samples[i + soon], ShortTermMotion::kSoon_s, sample.errors[2], sample.errors[3]);
  }
}

void fit(const char* name, const std::vector<ShortTermSample>& samples, std::ostream& out) {
  const auto before = errors_left(samples, {});
  const ShortTermWeights w = fit_network(samples);
  const auto after = errors_left(samples, w);
  char text[300];
  std::snprintf(text, sizeof text,
                "%zu moments of simulated walks and UCY zara01 pedestrians; errors now %.3f m "
                "(%.3f before) and %.3f m/s (%.3f), soon %.3f m (%.3f) and %.3f m/s (%.3f)",
                samples.size(), after[0], before[0], after[1], before[1], after[2], before[2],
                after[3], before[3]);
  std::cout << name << ": " << text << '\n';
  out << "// Fitted on " << text << ".\nconstexpr ShortTermWeights " << name << "{\n";
  write_rows(out, "hidden_even", w.hidden_even);
  write_rows(out, "hidden_odd", w.hidden_odd);
  write_rows(out, "along_hidden", w.along_hidden);
  write_rows(out, "across_hidden", w.across_hidden);
  write_rows(out, "along_even", w.along_even);
  write_rows(out, "across_odd", w.across_odd);
  out << "};\n\n";
}

int run(const std::string& tracks, const std::string& out_path) {
  std::vector<ShortTermSample> with_body, track_only;
  const auto add = [&](const Episode& episode) {
    add_samples(episode, with_body);
    add_samples(without_body(episode), track_only);
  };
  for (const SimulatedWalk& walk : fitting_turns()) add(simulate_walk(walk));
  for (const SimulatedWalk& walk : fitting_stops()) add(simulate_walk(walk));
  const std::size_t simulated = with_body.size();
  for (const RecordedWalk& walk : recorded_walks(tracks, kRecordedRounds))
    if (!is_held_out(walk)) add(walk.episode);
  if (with_body.size() == simulated) {
    std::cerr << "fit_motion: no recorded tracks in " << tracks << '\n';
    return 1;
  }
  std::ofstream out(out_path);
  out << "// Written by bench/prediction/fit_motion; do not edit.\n"
         "#include \"core/prediction/short_term_motion.hpp\"\n\nnamespace foretrack {\nnamespace "
         "{\n\n";
  fit("kWithBody", with_body, out);
  fit("kTrackAlone", track_only, out);
  out << "}  // namespace\n\nconst ShortTermWeights& short_term_weights(bool body_known) {\n"
         "  return body_known ? kWithBody : kTrackAlone;\n}\n\n}  // namespace foretrack\n";
  return out ? 0 : 1;
}

}  // namespace
}  // namespace foretrack::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fit_motion RECORDED_TRACKS OUT.cpp\n";
    return 2;
  }
  return foretrack::bench::run(argv[1], argv[2]);
}
