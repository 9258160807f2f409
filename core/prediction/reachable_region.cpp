// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/reachable_region.hpp"

#include <algorithm>

namespace foretrack {
namespace {

Vec3 level_direction(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad), 0.0};
}

// side: +1 left, −1 right.
double half_angle(const GridMap& map, const Vec3& position, const ReachableRegion& region,
                  double side, int rays) {
  const double quadrant = kPi / 2.0;
  int free = 0;
  for (int i = 0; i < rays; ++i) {
    const double yaw = region.heading_rad + side * quadrant * (i + 0.5) / rays;
    if (ray_distance_m(map, position, level_direction(yaw), region.radius_m) >= region.radius_m)
      ++free;
  }
  return 0.5 * quadrant * free / rays;
}

void measure_widths(const GridMap& map, const Vec3& here, const MotionCues& cues, double room_m,
                    Surroundings& s) {
  const Vec3 ahead = level_direction(cues.heading_rad);
  const Vec3 left(-ahead.y(), ahead.x(), 0.0);
  for (int i = 0; i < Surroundings::kSideCount; ++i) {
    const double way_m = i * Surroundings::kSideStep_s * cues.speed_m_s;
    if (way_m > room_m) break;
    const Vec3 there = here + way_m * ahead;
    s.left_width_m[i] = ray_distance_m(map, there, left, Surroundings::kSideRange_m);
    s.right_width_m[i] = ray_distance_m(map, there, -left, Surroundings::kSideRange_m);
  }
}

}  // namespace

ReachableRegion reachable_region(const GridMap& map, const Vec3& position_enu_m, double heading_rad,
                                 double speed_m_s, const PredictionParams& params) {
  ReachableRegion region;
  region.radius_m = std::max(speed_m_s * params.region_horizon_s, params.region_min_radius_m);
  region.heading_rad = heading_rad;
  const int rays = params.region_rays_per_side;
  region.left_half_angle_rad = half_angle(map, position_enu_m, region, 1.0, rays);
  region.right_half_angle_rad = half_angle(map, position_enu_m, region, -1.0, rays);
  return region;
}

Surroundings observe_surroundings(const GridMap& map, const MotionCues& cues,
                                  const PredictionParams& params) {
  Surroundings s;
  const Vec3 here(cues.state.position_m.x(), cues.state.position_m.y(), cues.height_m);
  const Vec3 ahead = level_direction(cues.heading_rad);
  s.region = reachable_region(map, here, cues.heading_rad, cues.speed_m_s, params);
  s.obstacle_distance_m = ray_distance_m(map, here, ahead, params.obstacle_range_m);
  const double room_m = std::max(0.0, s.obstacle_distance_m - params.target_radius_m);
  const double step_m = std::min(cues.speed_m_s * params.region_ahead_s, room_m);
  s.region_ahead =
      reachable_region(map, here + step_m * ahead, cues.heading_rad, cues.speed_m_s, params);
  measure_widths(map, here, cues, room_m, s);
  return s;
}

}  // namespace foretrack
