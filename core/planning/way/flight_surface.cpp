// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/flight_surface.hpp"

#include <array>
#include <limits>

#include "core/common/ground.hpp"
#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr int kBearings = 8;
constexpr double kTorsoLeast_m = 0.3;  // a torso is at least so high above the ground
constexpr double kHysteresis = 1.5;    // free places by which another level must be better

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

// Of the search height, nearest first.
constexpr std::array<double, 1 + kOtherLevels> kShares = {0.0,     -1.0 / 3, 1.0 / 3, -2.0 / 3,
                                                          2.0 / 3, -1.0,     1.0};

double lowest_level_m(const GridMap& map, const Vec3& target, const PlanningParams& params) {
  const std::optional<double> ground_m = ground_below_m(map, target);
  const bool below =
      ground_m && *ground_m < target.z() - kTorsoLeast_m;  // not the person in the map
  return below ? *ground_m + params.body.least_altitude_m
               : -std::numeric_limits<double>::infinity();
}

double level_of(double share, double lowest_m, const Vec3& target, const PlanningParams& params) {
  const double wanted_m = target.z() + params.place.height_above_target_m;
  return std::max(wanted_m + share * params.place.height_search_m, lowest_m);
}

}  // namespace

FlightSurface choose_flight_surface(const GridMap& map, const Vec3& start_enu_m,
                                    const Vec3& target_enu_m, const PlanningParams& params) {
  const double lowest_m = lowest_level_m(map, target_enu_m, params);
  FlightSurface surface{start_enu_m.head<2>(), start_enu_m.z(), target_enu_m.z()};
  double best = -1.0;
  for (const double share : kShares) {
    const double level_m = level_of(share, lowest_m, target_enu_m, params);
    const double count = free_places(map, start_enu_m, target_enu_m, level_m, params);
    if (best >= 0.0 && count < best + kHysteresis) continue;
    best = count;
    surface.level_z_m = level_m;
    if (count > 0.5 * kBearings) break;
  }
  return surface;
}

std::optional<FlightSurface> other_flight_surface(const GridMap& map, const Vec3& start_enu_m,
                                                  const Vec3& target_enu_m, int i,
                                                  const PlanningParams& params) {
  // Upwards first: what a person walks under or past is more often low than
  // high.
  constexpr std::array<std::size_t, kOtherLevels> kOrder = {2, 4, 6, 1, 3, 5};
  const double lowest_m = lowest_level_m(map, target_enu_m, params);
  const double level_m =
      level_of(kShares[kOrder[static_cast<std::size_t>(i)]], lowest_m, target_enu_m, params);
  const Vec3 there(start_enu_m.x(), start_enu_m.y(), level_m);
  const double required_m = std::min(params.path_clearance_m(), map.unfree_distance_m(start_enu_m));
  if (!is_clear(map, start_enu_m, there, required_m)) return {};
  return FlightSurface{start_enu_m.head<2>(), level_m, level_m};
}

}  // namespace foretrack
