// SPDX-License-Identifier: Apache-2.0
// When the followed person was where the vehicle cannot fly to, and when they were found again.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/simulator/world.hpp"
#include "services/offline/flight/flight_row.hpp"

namespace foretrack {

/// They are hidden while no place that the vehicle can fly to is within a step of them, for two
/// seconds at least, and reappear when one is again. Found: tracked, and in view, for half a second
/// from then on.
struct HidingRecord {
  double begin_s = 0.0, reappears_s = 0.0;
  double found_s = std::numeric_limits<double>::infinity();  // not before they reappear
  double least_gap_m =
      0.0;  // of the vehicle's hull to the person's, from then until the flight ends

  double hidden_s() const { return reappears_s - begin_s; }
  /// After they had reappeared.
  double until_found_s() const { return found_s - reappears_s; }
  bool found_within(double time_s) const { return until_found_s() <= time_s; }
};

/// So soon somebody is to be found.
inline constexpr double kFindWithin_s = 8.0;

/// In the order of their beginnings; those who do not reappear before the last kFindWithin_s of the
/// flight do not count. Precondition: rows at equal steps. Cost: that of the world's map.
std::vector<HidingRecord> hidings_of(std::span<const FlightRow> rows, const World& world,
                                     double map_resolution_m);

}  // namespace foretrack
