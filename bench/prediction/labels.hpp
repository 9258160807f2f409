// What the target really did next (docs: metrics of intention).
#pragma once

#include <optional>
#include <vector>

#include "bench/prediction/episodes.hpp"
#include "core/common/prediction.hpp"

namespace foretrack::bench {

/// Of the second after truth[i]: a turn if the heading changes by more than 30° while faster than
/// 0.3 m/s, else deceleration if the speed halves, else forward. None for who stands, or where the
/// second is not known.
std::optional<Intention> label_at(const std::vector<TruthSample>& truth, int i);

/// A turn of more than 30° within a second. It begins where the heading leaves the old one by 5°.
struct TurnEvent {
  Intention side = Intention::kTurnLeft;
  int onset = 0;  // index into truth
};
std::vector<TurnEvent> turn_events(const std::vector<TruthSample>& truth);

/// True if the next three seconds keep the heading within 15° and the speed above 70 %.
bool goes_straight(const std::vector<TruthSample>& truth, int i);

}  // namespace foretrack::bench
