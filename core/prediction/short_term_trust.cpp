// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/short_term_trust.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kGreatLoss_m = 0.5;
constexpr double kShare = 0.001;  // of a judgement
constexpr double kLate_s = 0.1;   // judged later, a forecast is not judged at all

double loss_of(const Vec2& error_m) {
  return std::min(1.0, error_m.squaredNorm() / (kGreatLoss_m * kGreatLoss_m));
}

void weigh(ShortTermTrust& trust, const ShortTermTrust::Said& said, const Vec2& position_m) {
  double sum = 0.0;
  for (int i = 0; i < kForecasterCount; ++i)
    sum += trust.weights[i] *= std::exp(-loss_of(said.position_m[i] - position_m));
  for (int i = 0; i < kForecasterCount; ++i)
    trust.weights[i] =
        (1.0 - kShare) * trust.weights[i] / sum + kShare * ShortTermTrust::kStrangers[i];
}

}  // namespace

double ShortTermTrust::in_chest() const {
  return of(Forecaster::kChest) / (of(Forecaster::kChest) + of(Forecaster::kTrack));
}

void judge(ShortTermTrust& trust, double stamp_s, const PlanarState& measured) {
  while (trust.count > 0) {
    const ShortTermTrust::Said& said = trust.said[trust.oldest];
    if (stamp_s < said.stamp_s) trust.count = 0;  // the clock goes back
    const double late_s = stamp_s - said.stamp_s - ShortTermTrust::kAhead_s;
    if (trust.count == 0 || late_s < -1e-6) return;
    if (late_s < kLate_s) weigh(trust, said, measured.position_m - late_s * measured.velocity_m_s);
    trust.oldest = (trust.oldest + 1) % ShortTermTrust::kKept;
    --trust.count;
  }
}

void note(ShortTermTrust& trust, double stamp_s, const ByForecaster<ShortTermMotion>& said) {
  constexpr int kKept = ShortTermTrust::kKept;
  const bool too_soon =
      trust.count > 0 && stamp_s < trust.newest().stamp_s + ShortTermTrust::kEvery_s - 1e-6;
  if (too_soon || trust.count == kKept) return;
  ShortTermTrust::Said& kept = trust.said[(trust.oldest + trust.count++) % kKept];
  kept.stamp_s = stamp_s;
  constexpr double kOn_s = ShortTermTrust::kAhead_s - ShortTermMotion::kSoon_s;
  for (int i = 0; i < kForecasterCount; ++i)
    kept.position_m[i] = said[i].soon.position_m + kOn_s * said[i].soon.velocity_m_s;
}

ShortTermMotion mixed(const ByForecaster<ShortTermMotion>& said, const ShortTermTrust& trust) {
  ShortTermMotion all;
  const auto add = [](PlanarState& sum, double weight, const PlanarState& one) {
    sum.position_m += weight * one.position_m;
    sum.velocity_m_s += weight * one.velocity_m_s;
  };
  for (int i = 0; i < kForecasterCount; ++i) {
    add(all.now, trust.weights[i], said[i].now);
    add(all.soon, trust.weights[i], said[i].soon);
  }
  return all;
}

}  // namespace foretrack
