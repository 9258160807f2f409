// What the target truly did in a flight: turns and sudden stops, and the labels of the intentions.
#pragma once

#include <span>
#include <vector>

#include "core/common/prediction.hpp"
#include "services/flight/flight_row.hpp"

namespace foretrack {

/// A turn by more than 30°, or a fall of the speed to less than half within 1 s.
struct TargetEvent {
  Intention kind = Intention::kTurnLeft;
  double begin_s = 0.0;  // the heading, or the speed, begins to change
  double end_s = 0.0;
  double turn_rad = 0.0;  // positive to the left
};

/// In the order of their beginnings. Precondition: rows at equal steps.
std::vector<TargetEvent> events_of(std::span<const FlightRow> rows);

/// The intention over the second after each row, from the true future: left or right if the heading
/// changes by more than 30° (both speeds above 0.3 m/s), else deceleration if the speed halves,
/// else forward. Rows in the last second, and those of a standing target, have none (−1).
std::vector<int> labels_of(std::span<const FlightRow> rows);

}  // namespace foretrack
