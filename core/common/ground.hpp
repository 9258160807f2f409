// SPDX-License-Identifier: Apache-2.0
// The ground below a place, as the map knows it.
#pragma once

#include <optional>

#include "core/common/grid_map.hpp"

namespace foretrack {

/// Height of the ground below a point, ENU: of the first occupied cell's upper face below it. What
/// is narrower than 1.5 m (a hedge, a table, a bar) stands on the ground and is none. The lower
/// edge of a map that is known (stamp 0) is ground too. None where unknown space comes first:
/// nobody has seen the ground there. Cost: five lookups a cell of height.
std::optional<double> ground_below_m(const GridMap& map, const Vec3& point_enu_m);

}  // namespace foretrack
