// SPDX-License-Identifier: Apache-2.0
// Where the vehicles of a fleet begin.
#pragma once

#include "core/simulator/scenario.hpp"

namespace foretrack {

/// A place for each of scenario.vehicles: as it says, or round the person, behind them first, where
/// there is room, they are seen, and no other vehicle is near. Throws std::invalid_argument, naming
/// the vehicle, where there is none.
std::vector<Vec3> fleet_starts(const Scenario& scenario, const World& world, const Person& person);

/// The scenario as one of its vehicles flies it: it alone, at its start, with noise of its own.
Scenario scenario_of(const Scenario& scenario, std::size_t vehicle, const Vec3& start_enu_m,
                     const Person& person);

}  // namespace foretrack
