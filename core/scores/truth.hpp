// SPDX-License-Identifier: Apache-2.0
// What the target really did: its intentions, turns and stops as only the future can tell them.
#pragma once

#include <optional>
#include <vector>

#include "core/common/geometry.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {

struct TruthSample {
  Vec2 position_m = Vec2::Zero();
  Vec2 velocity_m_s = Vec2::Zero();
  double speed_m_s() const { return velocity_m_s.norm(); }
};

/// At equal steps; samples[0] is of time 0.
struct Truth {
  double step_s = 0.02;
  std::vector<TruthSample> samples;

  int count() const { return static_cast<int>(samples.size()); }
  int steps(double duration_s) const { return static_cast<int>(std::lround(duration_s / step_s)); }
  bool knows(double time_s) const { return time_s >= 0.0 && steps(time_s) < count(); }
  const TruthSample& at(double time_s) const { return samples[steps(time_s)]; }
};

/// Of the second after samples[i]: a turn if the heading changes by more than 30° while faster than
/// 0.3 m/s, else deceleration if the speed halves (a turn, if one follows within another second:
/// who slows down for a corner does not mean to stop), else forward. None for who stands, or where
/// the second is not known.
std::optional<Intention> label_at(const Truth& truth, int i);

/// A turn of more than 30° within a second begins where the heading leaves the old one by 5°; a
/// stop, which halves the speed within a second without a turn, where 5 % of the speed are gone.
struct TruthEvent {
  Intention kind = Intention::kTurnLeft;
  double onset_s = 0.0;
};
std::vector<TruthEvent> turns_of(const Truth& truth);
std::vector<TruthEvent> stops_of(const Truth& truth);

/// To another way, whichever.
constexpr bool is_turn(Intention i) {
  return i == Intention::kTurnLeft || i == Intention::kTurnRight;
}

/// True if the next three seconds keep the heading within 15° and the speed above 70 %.
bool goes_straight(const Truth& truth, int i);

}  // namespace foretrack
