// SPDX-License-Identifier: Apache-2.0
// Where the target may be within a second (paper §III.B).
#pragma once

#include <array>

#include "core/common/grid_map.hpp"
#include "core/common/prediction.hpp"
#include "core/prediction/motion_cues.hpp"

namespace foretrack {

/// The surroundings as far as intentions need them. Only occupied cells matter: what the vehicle
/// does not know does not stop the target.
struct Surroundings {
  ReachableRegion region;            // R(t)
  ReachableRegion region_ahead;      // R(t + t0)
  double obstacle_distance_m = 0.0;  // d_obs, along the heading; the range when nothing is there
  // Free width to each side now and along the way ahead, at most kSideRange_m; 0 behind an
  // obstacle.
  static constexpr int kSideCount = 7;
  static constexpr double kSideStep_s = 0.2;
  static constexpr double kSideRange_m = 2.5;
  std::array<double, kSideCount> left_width_m{};
  std::array<double, kSideCount> right_width_m{};
};

/// θ of each side is half of the unobstructed angle in its quadrant: rays at the target's height
/// from the heading out to ±90°. Cost: 2 · rays_per_side ray casts.
ReachableRegion reachable_region(const GridMap& map, const Vec3& position_enu_m, double heading_rad,
                                 double speed_m_s, const PredictionParams& params);

/// The region now, and from where constant velocity leads in t0, or stops short of an obstacle.
Surroundings observe_surroundings(const GridMap& map, const MotionCues& cues,
                                  const PredictionParams& params);

}  // namespace foretrack
