// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/map_rays.hpp"

#include <algorithm>

namespace foretrack {
namespace {

// A cell's distance runs from its centre; a point of the cell is at most 0.87 cells from it.
constexpr double kSlackCells = 0.9;
constexpr double kStepCells = 0.5;
constexpr double kInside_m = 1e-6;
constexpr int kOutside = -1;

// A segment in cells, so that a lookup is a multiplication and a cast.
struct Ray {
  Ray(const GridMap& map_in, const std::vector<std::uint8_t>& distances, const Vec3& from,
      const Vec3& to)
      : map(map_in),
        distance_cm(distances.data()),
        origin((from - map_in.origin_enu_m) / map_in.resolution_m),
        length_m((to - from).norm()),
        direction(length_m > 1e-9 ? Vec3((to - from) / (length_m * map_in.resolution_m))
                                  : Vec3::Zero()) {}

  // Of the cell that holds the point, or kOutside.
  int at(double at_m) const {
    const double x = origin.x() + at_m * direction.x();
    const double y = origin.y() + at_m * direction.y();
    const double z = origin.z() + at_m * direction.z();
    const bool inside = x >= 0.0 && y >= 0.0 && z >= 0.0 && x < map.size.x() && y < map.size.y() &&
                        z < map.size.z();
    if (!inside) return kOutside;
    return distance_cm[map.offset_of(
        {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)})];
  }

  // From there on (sign 1) or back (-1) until the ray is in the next cell.
  double to_next_cell_m(double at_m, double sign) const {
    double least_m = length_m;
    for (int a = 0; a < 3; ++a) {
      const double speed = sign * direction[a];
      if (std::abs(speed) < 1e-9) continue;
      const double c = origin[a] + at_m * direction[a];
      least_m =
          std::min(least_m, (speed > 0.0 ? std::floor(c) + 1.0 - c : std::floor(c) - c) / speed);
    }
    return std::max(least_m, 0.0) + kInside_m;
  }

  const GridMap& map;
  const std::uint8_t* distance_cm;
  Vec3 origin;
  double length_m;
  Vec3 direction;
};

}  // namespace

bool sees(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double skip_m) {
  const Ray ray(map, map.occupied_distance_cm, from_enu_m, to_enu_m);
  const double slack_m = kSlackCells * map.resolution_m, step_m = kStepCells * map.resolution_m;
  // From both ends towards each other: mostly they meet at once.
  double low_m = std::min(skip_m, ray.length_m), high_m = ray.length_m;
  while (low_m <= high_m) {
    const int high = ray.at(high_m);
    if (high == 0) return false;
    high_m -= std::max(0.01 * high - slack_m, step_m);
    if (low_m > high_m) break;
    const int low = ray.at(low_m);
    if (low == 0) return false;
    low_m += std::max(0.01 * low - slack_m, step_m);
  }
  return true;
}

bool is_clear(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double required_m) {
  const Ray ray(map, map.unfree_distance_cm, from_enu_m, to_enu_m);
  const double slack_m = 2.0 * kSlackCells * map.resolution_m;  // of this cell and the one there
  double low_m = 0.0, high_m = ray.length_m;
  while (low_m <= high_m) {
    const double high = 0.01 * ray.at(high_m);
    if (high < required_m) return false;
    high_m -= std::max(high - required_m - slack_m, ray.to_next_cell_m(high_m, -1.0));
    if (low_m > high_m) break;
    const double low = 0.01 * ray.at(low_m);
    if (low < required_m) return false;
    low_m += std::max(low - required_m - slack_m, ray.to_next_cell_m(low_m, 1.0));
  }
  return true;
}

}  // namespace foretrack
