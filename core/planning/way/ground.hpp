// SPDX-License-Identifier: Apache-2.0
// The ground below a place, as the map knows it.
#pragma once

#include <optional>

#include "core/common/grid_map.hpp"

namespace foretrack {

/// Height of the first occupied cell's upper face below a point, ENU. The lower edge of a map that
/// is known (stamp 0) is ground too. None where unknown space comes first: nobody has seen the
/// ground there. Cost: one lookup a cell of height.
std::optional<double> ground_below_m(const GridMap& map, const Vec3& point_enu_m);

}  // namespace foretrack
