// SPDX-License-Identifier: Apache-2.0
// What the other stages make of a fleet. Without one, nothing: each gives back what it is given.
#pragma once

#include "core/common/framing.hpp"
#include "core/fleet/coordinate.hpp"

namespace foretrack {

inline constexpr double kFleetPeriod_s = 0.1;  ///< between two messages
inline constexpr double kFleetStale_s = 0.5;   ///< what the others see is used for so long
inline constexpr double kPeersStale_s = 1.0;   ///< and where they are

/// Who sees the person goes by its own eyes. Who does not goes by what the others see (`told`), as
/// long as that is fresh.
const TargetState& seen_by_any(const TargetState& own, const TargetState& told, double now_s);

/// From where to look: as an operator orders; where nothing is ordered, from the seat.
Framing framing_of(const Framing& ordered, const SeatPlace& place, const FleetParams& params);

/// Bodies that are tracked and other vehicles, unless those are stale: all that planner and gate
/// keep clear of. Stamped as the tracked ones.
MovingBodies all_of(const MovingBodies& around, const MovingBodies& peers, double now_s);

}  // namespace foretrack
