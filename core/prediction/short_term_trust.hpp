// SPDX-License-Identifier: Apache-2.0
// How far each of those who tell the next moment came true lately.
#pragma once

#include <array>

#include "core/prediction/short_term_motion.hpp"

namespace foretrack {

/// What somebody who tells the next moment reads.
enum class Forecaster : std::uint8_t {
  kChest,  // the network, of track and chest
  kTrack,  // the network, of the track alone
  kFilter  // the filter's velocity
};
inline constexpr int kForecasterCount = 3;
/// One of each forecaster.
template <class T>
using ByForecaster = std::array<T, kForecasterCount>;

/// Exponential weights with a fixed share (Herbster and Warmuth 1998): a judgement multiplies each
/// by exp(−loss), loss being in [0, 1] and 1 half a metre off, half a second ahead, and gives 0.001
/// back to what is believed of strangers. So whatever comes, the weighted mean of the losses sums
/// to at most 1.6 (L + 3.7 + 0.01 t), L being that of the best of the three alone and t the
/// seconds, by the weights at the time of judgement; and 17 more whenever another becomes the best.
/// Owned by the caller of predict().
struct ShortTermTrust {
  static constexpr double kAhead_s = 0.5;  ///< how far ahead forecasts are judged
  static constexpr double kEvery_s = 0.1;
  static constexpr int kKept = 8;
  static constexpr ByForecaster<double> kStrangers = {0.95, 0.025, 0.025};
  struct Said {
    double stamp_s = 0.0;
    ByForecaster<Vec2> position_m{};  ///< at stamp_s + kAhead_s
    const Vec2& of(Forecaster who) const { return position_m[static_cast<std::size_t>(who)]; }
  };
  std::array<Said, kKept> said{};  ///< a ring
  int oldest = 0, count = 0;
  ByForecaster<double> weights = kStrangers;  ///< sum to 1

  /// What was said last; precondition: something was.
  const Said& newest() const { return said[(oldest + count + kKept - 1) % kKept]; }
  double of(Forecaster who) const { return weights[static_cast<std::size_t>(who)]; }
  /// How far the chest is worth reading, in [0, 1].
  double in_chest() const;
};

/// Judges what was said for this moment. A stamp that goes back forgets what was said.
void judge(ShortTermTrust& trust, double stamp_s, const PlanarState& measured);

/// Keeps what is said now, kEvery_s after the last at the earliest.
void note(ShortTermTrust& trust, double stamp_s, const ByForecaster<ShortTermMotion>& said);

/// What they say together.
ShortTermMotion mixed(const ByForecaster<ShortTermMotion>& said, const ShortTermTrust& trust);

}  // namespace foretrack
