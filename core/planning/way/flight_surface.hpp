// SPDX-License-Identifier: Apache-2.0
// The level at which the vehicle flies.
#pragma once

#include <algorithm>
#include <optional>

#include "core/common/grid_map.hpp"
#include "core/planning/plan_params.hpp"

namespace foretrack {

/// A cone that leads from the vehicle's height to the wanted level, so that searches in the plane
/// are at the height at which the vehicle can be.
struct FlightSurface {
  Vec2 center_m = Vec2::Zero();
  double start_z_m = 0.0;
  double level_z_m = 0.0;
  double slope = 1.0;

  bool flat() const { return std::abs(level_z_m - start_z_m) < 1e-6; }
  double z_at(const Vec2& xy) const {
    if (flat()) return level_z_m;
    const double reach_m = slope * (xy - center_m).norm();
    return start_z_m + std::clamp(level_z_m - start_z_m, -reach_m, reach_m);
  }
  Vec3 at(const Vec2& xy) const { return {xy.x(), xy.y(), z_at(xy)}; }
};

/// The level is the wanted height above the target; if little is free there around the vehicle and
/// the target, the nearest level within height_search_m that is freer. No level is lower than
/// least_altitude_m above the ground below the target, as far as the map knows that ground. Cost: <
/// 100 lookups.
FlightSurface choose_flight_surface(const GridMap& map, const Vec3& start_enu_m,
                                    const Vec3& target_enu_m, const PlanningParams& params);

/// How many other levels there are to try.
inline constexpr int kOtherLevels = 6;
/// The i-th other level, i = 0 … kOtherLevels − 1: for when no way was found, as something that is
/// not around the vehicle or the target lies between them. It is flat: the vehicle rises or sinks
/// to it where it is. None where that is not clear.
std::optional<FlightSurface> other_flight_surface(const GridMap& map, const Vec3& start_enu_m,
                                                  const Vec3& target_enu_m, int i,
                                                  const PlanningParams& params);

}  // namespace foretrack
