// SPDX-License-Identifier: Apache-2.0
// The corridor ends before people and vehicles.
#pragma once

#include "core/planning/way/waypoint_search.hpp"

namespace foretrack {

/// Lays planes between a segment, which is flown from from_s to to_s after the way's begin, and the
/// places where bodies are expected meanwhile, the check's gap before them or as much of it as
/// leaves room for the segment. Somebody who crosses the segment is passed in time, not in space:
/// there is no plane for them; nor for those who are flown over. Cost: below a microsecond a body.
void cut_bodies(const SearchContext& context, const Vec3& from_enu_m, const Vec3& to_enu_m,
                double from_s, double to_s, Polytope& polytope);

}  // namespace foretrack
