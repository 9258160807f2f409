// SPDX-License-Identifier: Apache-2.0
// What the target truly did in a flight: turns and sudden stops.
#pragma once

#include <span>
#include <vector>

#include "core/prediction/intentions/intention_table.hpp"
#include "services/offline/flight/flight_row.hpp"

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

}  // namespace foretrack
