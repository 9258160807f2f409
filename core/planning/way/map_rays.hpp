// SPDX-License-Identifier: Apache-2.0
// Rays through the distance grids: they jump by the free distance instead of visiting every cell.
#pragma once

#include "core/common/grid_map.hpp"

namespace foretrack {

/// True if no occupied cell lies between the points; the first skip_m from `from` do not count (the
/// person itself may be in the map). Unknown cells do not block sight. Beside line_of_sight() it
/// may miss corners that the segment cuts by less than half a cell. Cost: about 3–10 lookups.
bool sees(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double skip_m);

/// True if every point of the segment is at least required_m from occupied, unknown and outside
/// space, by the value of the cell that holds it. Cost: about 3–10 lookups.
bool is_clear(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double required_m);

}  // namespace foretrack
