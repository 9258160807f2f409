// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/flight_surface.hpp"

#include <array>

namespace foretrack {
namespace {

constexpr int kBearings = 8;
constexpr double kHysteresis = 1.5;  // free places by which another level must be better

// How many of the places that matter are free at this level: a ring around the target and the
// vehicle's own place.
double free_places(const GridMap& map, const Vec3& start, const Vec3& target, double level_m,
                   const PlanningParams& params) {
  const double required_m = params.path_clearance_m();
  const auto is_free = [&](const Vec2& xy) {
    return map.unfree_distance_m({xy.x(), xy.y(), level_m}) >= required_m ? 1.0 : 0.0;
  };
  double count = 2.0 * is_free(start.head<2>());
  for (int i = 0; i < kBearings; ++i)
    count += is_free(target.head<2>() +
                     params.distance_wanted_m() * direction_of(2.0 * kPi * i / kBearings));
  return count;
}

}  // namespace

FlightSurface choose_flight_surface(const GridMap& map, const Vec3& start_enu_m,
                                    const Vec3& target_enu_m, const PlanningParams& params) {
  const double wanted_m = target_enu_m.z() + params.place.height_above_target_m;
  constexpr std::array<double, 7> kShares = {0.0, -1.0 / 3, 1.0 / 3, -2.0 / 3, 2.0 / 3, -1.0, 1.0};
  FlightSurface surface{start_enu_m.head<2>(), start_enu_m.z(), wanted_m};
  double best = -1.0;
  for (const double share : kShares) {
    const double level_m = wanted_m + share * params.place.height_search_m;
    const double count = free_places(map, start_enu_m, target_enu_m, level_m, params);
    if (best >= 0.0 && count < best + kHysteresis) continue;
    best = count;
    surface.level_z_m = level_m;
    if (count > 0.5 * kBearings) break;
  }
  return surface;
}

}  // namespace foretrack
