// SPDX-License-Identifier: Apache-2.0
// Where a vehicle may fly, as an operator writes it down:
//
//   fence_m: [[-20, -10], [20, -10], [20, 30], [-20, 30]]   # corners, world ENU; none: no fence
//   altitude_min_m: 1.0          # over the ground below; either may be left out: no bound
//   altitude_max_m: 12.0
#pragma once

#include <filesystem>

#include "core/safety/flight_bounds.hpp"

namespace foretrack {

/// Throws std::invalid_argument that names every fault with file and line, also bounds that no gate
/// would take: see are_valid(). A file that bounds nothing must say so: "fence_m: []".
FlightBounds load_bounds(const std::filesystem::path& file);

}  // namespace foretrack
