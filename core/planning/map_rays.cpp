#include "core/planning/map_rays.hpp"

#include <algorithm>

namespace foretrack {
namespace {

// A cell's distance runs from its centre; a point of the cell is at most 0.87 cells from it.
constexpr double kSlackCells = 0.9;
constexpr double kStepCells = 0.5;

// Where the ray is, in cells, so that a lookup is a cast and a multiplication.
struct Ray {
  Ray(const GridMap& map, const Vec3& from, const Vec3& to)
      : origin((from - map.origin_enu_m) / map.resolution_m), length_m((to - from).norm()) {
    direction = length_m > 1e-9 ? Vec3((to - from) / (length_m * map.resolution_m)) : Vec3::Zero();
  }
  Eigen::Vector3i cell(double at_m) const {
    return (origin + at_m * direction).array().floor().cast<int>();
  }
  Vec3 origin, direction;
  double length_m;
};

}  // namespace

bool sees(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double skip_m) {
  const Ray ray(map, from_enu_m, to_enu_m);
  const double slack_m = kSlackCells * map.resolution_m, step_m = kStepCells * map.resolution_m;
  for (double at_m = std::min(skip_m, ray.length_m); at_m <= ray.length_m;) {
    const Eigen::Vector3i cell = ray.cell(at_m);
    if (!map.contains(cell)) {
      at_m += step_m;
      continue;
    }
    const int distance_cm = map.occupied_distance_cm[map.offset_of(cell)];
    if (distance_cm == 0) return false;
    at_m += std::max(0.01 * distance_cm - slack_m, step_m);
  }
  return true;
}

bool is_clear(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m, double required_m) {
  const Ray ray(map, from_enu_m, to_enu_m);
  const double slack_m = 2.0 * kSlackCells * map.resolution_m;  // of this cell and the one there
  const double step_m = kStepCells * map.resolution_m;
  for (double at_m = 0.0;; at_m = std::min(at_m, ray.length_m)) {
    const Eigen::Vector3i cell = ray.cell(at_m);
    if (!map.contains(cell)) return false;
    const double distance_m = 0.01 * map.unfree_distance_cm[map.offset_of(cell)];
    if (distance_m < required_m) return false;
    if (at_m >= ray.length_m) return true;
    at_m += std::max(distance_m - required_m - slack_m, step_m);
  }
}

}  // namespace foretrack
