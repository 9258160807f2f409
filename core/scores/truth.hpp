// SPDX-License-Identifier: Apache-2.0
// What the target really did: its intentions, turns and stops as only the future can tell them.
#pragma once

#include <optional>
#include <vector>

#include "core/common/geometry.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {

/// Where the target really was, and how it moved.
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

/// What the target meant at samples[i], by the second that follows. The first that holds counts:
///
/// - A turn, if the heading changes by more than 30° while the target is faster than 0.3 m/s.
/// - If the speed halves: a turn, if one follows within another second; else deceleration. Who
/// slows
///   down for a corner does not mean to stop.
/// - Forward.
///
/// None: the target stands (slower than 0.3 m/s), or the second is not known. Cost: linear in the
/// samples of a second.
std::optional<Intention> label_at(const Truth& truth, int i);

/// A turn or a stop that really happened, and when it began. A turn changes the heading by more
/// than 30° within a second; it begins where the heading has left the old one by 5°. A stop halves
/// the speed within a second without a turn; it begins where 5 % of the speed are gone.
struct TruthEvent {
  Intention kind = Intention::kTurnLeft;
  double onset_s = 0.0;  ///< on the clock of the truth
};
/// The turns of a walk, in order of time; each is found once.
std::vector<TruthEvent> turns_of(const Truth& truth);
/// The stops of a walk, in order of time; each is found once.
std::vector<TruthEvent> stops_of(const Truth& truth);

/// To another way, whichever.
constexpr bool is_turn(Intention i) {
  return i == Intention::kTurnLeft || i == Intention::kTurnRight;
}

/// True if in the three seconds after samples[i] the heading stays within 15° of what it is there,
/// and the speed above 70 % of it. False where the target stands or the three seconds are not
/// known.
bool goes_straight(const Truth& truth, int i);

}  // namespace foretrack
