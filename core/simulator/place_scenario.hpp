// SPDX-License-Identifier: Apache-2.0
// A scenario around a vehicle that is not simulated: where it stands, and from when on.
#pragma once

#include "core/simulator/simulate.hpp"

namespace foretrack {

/// Turns the scenario's world and people by quarters, so that walls stay along the axes, and moves
/// them so that the person stands straight ahead of the vehicle at the usual distance, with the
/// ground at z = 0. Throws std::invalid_argument if there is no such place.
void place_scenario(SimulatorState& state, const VehicleState& vehicle);

/// From now on the scenario's time is that of a clock which is at now_s: what people do by the
/// clock and what cameras do is put off.
void begin_at(SimulatorState& state, double now_s);

}  // namespace foretrack
