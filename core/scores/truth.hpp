// SPDX-License-Identifier: Apache-2.0
// What the person really did. A label says what a moment was the beginning of; an event is a turn
// or a stop from its beginning to its end. Both need the future: they judge, they do not predict.
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

/// A walk in samples at equal steps; samples[0] is of time 0.
struct Truth {
  double step_s = 0.02;
  std::vector<TruthSample> samples;

  int count() const { return static_cast<int>(samples.size()); }
  int steps(double duration_s) const { return static_cast<int>(std::lround(duration_s / step_s)); }
  bool knows(double time_s) const { return time_s >= 0.0 && steps(time_s) < count(); }
  const TruthSample& at(double time_s) const { return samples[steps(time_s)]; }
};

/// The intention of samples[i], by what follows. The first of these that holds:
/// - turn back: within 2 s the heading is more than 120° from the present one (a motion that
///   reverses is the plainest case);
/// - turn left, turn right: within 1 s it is more than 30° from it;
/// - turn left, turn right: within 1 s the speed halves, and such a turn follows within another
///   second. Who slows down for a corner does not mean to stop;
/// - decelerate: within 1 s the speed halves;
/// - forward.
/// None while the person stands (0.3 m/s), and where the next 2 s are not known.
std::optional<Intention> label_at(const Truth& truth, int i);

/// The label of who stands now (0.2 m/s) and will walk within a second (0.5 m/s). No intention of
/// this kind is predicted yet.
bool sets_off(const Truth& truth, int i);

/// Labels that change the way.
constexpr bool is_turn(Intention i) {
  return i == Intention::kTurnLeft || i == Intention::kTurnRight || i == Intention::kTurnBack;
}

/// A turn, a stop or a turn back that really happened.
struct TruthEvent {
  Intention kind = Intention::kTurnLeft;
  double begin_s = 0.0;  // the heading, or the speed, begins to change
  double end_s = 0.0;
  double turn_rad = 0.0;  // of a turn: positive to the left
};

/// A turn: the heading changes faster than 0.4 rad/s in one sense, with pauses of less than 0.3 s,
/// and by more than 30° in all. Left or right, however far it goes.
std::vector<TruthEvent> turns_of(const Truth& truth);

/// A stop: the speed falls faster than 0.5 m/s² until less than half of it is left, whatever
/// follows.
std::vector<TruthEvent> stops_of(const Truth& truth);

/// Turns and stops, in the order of their beginnings.
std::vector<TruthEvent> turns_and_stops_of(const Truth& truth);

/// The same events as intentions foretell them, by the label of their beginnings: a turn, or a
/// stop, that begins a turn back is one; a stop that begins a turn is none.
std::vector<TruthEvent> intended_events_of(const Truth& truth);

/// True if the next three seconds keep the heading within 15° and the speed above 70 %.
bool goes_straight(const Truth& truth, int i);

}  // namespace foretrack
