// SPDX-License-Identifier: Apache-2.0
// A flight as the scores see it: what the target did, and what was said of it.
#pragma once

#include <span>

#include "core/scores/score_intentions.hpp"
#include "services/offline/flight/flight_row.hpp"

namespace foretrack {

/// Time 0 is that of the first row. Precondition: at least two rows, at equal steps.
Truth truth_of(std::span<const FlightRow> rows);

/// Turns and stops, in the log's time. Precondition: as above.
std::vector<TruthEvent> events_of(std::span<const FlightRow> rows);

/// The probabilities at the time at which they are known, sensor delay and all.
IntentionScorer score_intentions(std::span<const FlightRow> rows, const Truth& truth);

}  // namespace foretrack
