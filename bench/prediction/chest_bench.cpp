// SPDX-License-Identifier: Apache-2.0
// How far off the beginning of all paths is half a second ahead, by who tells it, for each chest:
// at 2 m/s between boxes, without a flight. Usage: chest_bench [FIRST_SEED [WALKS]]
#include <cstdio>
#include <cstdlib>

#include "bench/prediction/chests.hpp"
#include "core/prediction/motion_cues.hpp"

namespace foretrack::bench {
namespace {

constexpr double kAhead_s = 0.5;
constexpr double kTurn_rad = rad(20.0);  // of the course, from kBefore_s on until kAhead_s
constexpr double kBefore_s = 0.3;

// Sums of squared errors.
struct Errors {
  double squared_m2 = 0.0;
  int count = 0;
  void add(const Vec2& error_m) {
    squared_m2 += error_m.squaredNorm();
    ++count;
  }
  double rms_m() const { return std::sqrt(squared_m2 / std::max(1, count)); }
};

struct Row {
  Errors filter, track, chest, mixed;
  double trust_in_chest = 0.0;
};

bool turns(const Truth& truth, int i) {
  const Vec2 &before = truth.samples[i - truth.steps(kBefore_s)].velocity_m_s,
             &after = truth.samples[i + truth.steps(kAhead_s)].velocity_m_s;
  return before.norm() > 0.3 && after.norm() > 0.3 &&
         std::abs(wrap_angle(yaw_of(after) - yaw_of(before))) > kTurn_rad;
}

Vec2 told_m(const PlanarState& soon, double after_s) {
  return soon.position_m + (kAhead_s - after_s) * soon.velocity_m_s;
}

void run(const Episode& episode, Row& turning, Row& straight) {
  const PredictionParams params;
  const Truth& truth = episode.truth;
  MotionMemory memory;
  for (int k = 0; k < static_cast<int>(episode.estimates.size()); ++k) {
    const MotionCues cues = observe_motion(memory, episode.estimates[k], params);
    const int i = k * kTruthPerEstimate;
    if (i < truth.steps(kBefore_s) || i + truth.steps(kAhead_s) >= truth.count()) continue;
    if (truth.samples[i].speed_m_s() < 0.3) continue;
    Row& row = turns(truth, i) ? turning : straight;
    const Vec2 came_m = truth.samples[i + truth.steps(kAhead_s)].position_m;
    row.filter.add(told_m(cues.measured, 0.0) - came_m);
    const ShortTermTrust::Said& said = memory.trust.newest();
    if (said.stamp_s == episode.estimates[k].stamp_s) {
      row.track.add(said.of(Forecaster::kTrack) - came_m);
      row.chest.add(said.of(Forecaster::kChest) - came_m);
    }
    row.mixed.add(told_m(cues.soon, ShortTermMotion::kSoon_s) - came_m);
    row.trust_in_chest += memory.trust.of(Forecaster::kChest);
  }
}

void print(const Row& row) {
  std::printf(" | %5.2f %5.2f %5.2f %5.2f %5.2f", row.filter.rms_m(), row.track.rms_m(),
              row.chest.rms_m(), row.mixed.rms_m(),
              row.trust_in_chest / std::max(1, row.mixed.count));
}

int run(std::uint64_t first_seed, int walks) {
  std::printf(
      "RMS error 0.5 s ahead [m] of filter, network of the track, network of the chest, all mixed; "
      "mean weight of the chest\n%-18s | %-29s | %s\n",
      "chest", "turning", "straight");
  for (const NamedChest& named : kChests) {
    Row turning, straight;
    for (int i = 0; i < walks; ++i) {
      SimulatedWalk walk{.kind = WorldKind::kBoxes,
                         .seed = first_seed + static_cast<std::uint64_t>(i),
                         .speed_m_s = 2.0};
      walk.chest = named.chest;
      run(simulate_walk(walk), turning, straight);
    }
    std::printf("%-18s", named.name.data());
    print(turning);
    print(straight);
    std::printf("\n");
  }
  return 0;
}

}  // namespace
}  // namespace foretrack::bench

int main(int argc, char** argv) {
  const std::uint64_t first_seed = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 101;
  return foretrack::bench::run(first_seed, argc > 2 ? std::atoi(argv[2]) : 12);
}
