// SPDX-License-Identifier: Apache-2.0
// Parameters of the whole planning stage.
#pragma once

#include <algorithm>

#include "core/common/params.hpp"
#include "core/planning/motion/check_trajectory.hpp"
#include "core/planning/motion/flight_limits.hpp"
#include "core/planning/motion/keep_clear.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"

namespace foretrack {

/// Which target positions are planned for, and from which state.
struct HorizonParams {
  double horizon_s = 3.0;
  double step_s = 0.2;
  double replan_lead_s = 0.02;
  double restart_distance_m = 0.6;
  double plan_period_s = 0.03;
  double plan_latest_s = 0.05;
  double vehicle_stale_s = 0.5;
  double target_stale_s = 0.6;
  double map_stale_s = 2.0;
  double search_s = 12.0;
  double target_radius_m = 0.35;
  bool hedging = true;
  bool intention_margins = true;
  double path_probability_min = 0.06;
  double merge_distance_m = 0.12;
  double later_discount_per_s = 0.6;
};

/// Where the vehicle wants to be: ring, visible regions, heights, corridor.
struct PlaceParams {
  double distance_low_m = 1.5;
  double distance_high_m = 2.5;
  double reserve_low_m = 0.3;
  double reserve_high_m = 0.3;
  double distance_extra_m = 0.3;
  double ring_tolerance_m = 0.2;
  double margin_min_rad = 0.12;
  double margin_extra_rad = 0.4;
  double margin_share_max = 0.7;
  double height_above_target_m = 0.1;
  double height_search_m = 0.6;
  double search_clearance_m = 0.02;
  int search_expansions_max = 2000;
  int sector_steps = 24;
  double corridor_clearance_m = 0.03;
  double corridor_reach_m = 1.2;
  double corridor_height_m = 0.5;
  double segment_max_m = 2.5;
  int polytopes_max = 5;

  double kept_low_m() const { return distance_low_m + reserve_low_m; }
  double kept_high_m() const { return std::max(distance_high_m - reserve_high_m, kept_low_m()); }
  /// d̂_l: a likely deceleration narrows the band from below.
  double kept_low_m(double score_decelerate) const {
    return std::min(kept_low_m() + distance_extra_m * score_decelerate, kept_high_m());
  }
};

/// Field of view and what the camera's axes may do.
struct ViewParams {
  double fov_horizontal_rad = 1.5708;
  double fov_margin_rad = 0.2;
  bool yaw_ahead = true;
  double yaw_effort = 0.002;
  double search_look_s = 1.0;
  double search_rate_rad_s = 1.2;
  double search_speed_m_s = 1.0;
  bool gimbal = false;
  double gimbal_rate_max_rad_s = 2.0;
  double gimbal_acceleration_max_rad_s2 = 10.0;
};

/// All parameters of planning, by what they decide.
struct PlanningParams {
  HorizonParams horizon;
  PlaceParams place;
  ViewParams view;
  FlightLimits limits;
  OptimizerParams optimizer;
  CheckParams check;
  GapParams body;

  double distance_wanted_m() const { return 0.5 * (place.kept_low_m() + place.kept_high_m()); }
  double path_clearance_m() const { return check.vehicle_radius_m + place.search_clearance_m; }
};
/// Every row of every part, in the order above.
ParamRows rows(PlanningParams& params);

}  // namespace foretrack
