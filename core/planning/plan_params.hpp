// SPDX-License-Identifier: Apache-2.0
// Parameters of the whole planning stage.
#pragma once

#include <algorithm>

#include "core/common/params.hpp"
#include "core/planning/motion/check_trajectory.hpp"
#include "core/planning/motion/flight_limits.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"

namespace foretrack {

/// Which target positions are planned for, and from which state.
struct HorizonParams {
  double horizon_s = 3.0;              // T_p
  double step_s = 0.2;                 // Δ
  double replan_lead_s = 0.02;         // a new plan joins the flown one this far ahead
  double restart_distance_m = 0.6;     // further from the flown trajectory: start where it is
  double plan_period_s = 0.03;         // least time between two replans
  double plan_latest_s = 0.05;         // without new data it is replanned after that long
  double vehicle_stale_s = 0.5;        // an older vehicle state is not planned from
  double target_stale_s = 0.6;         // an older target is lost, an older prediction not used
  double map_stale_s = 2.0;            // an older map is none
  double search_s = 12.0;              // a lost target is searched for so long
  double target_radius_m = 0.35;       // around the person the map may hold the person
  bool hedging = true;                 // expectation over the intention paths
  bool intention_margins = true;       // θ_εl, θ_εr, d̂_l
  double path_probability_min = 0.06;  // less likely paths are not hedged against
  double merge_distance_m = 0.12;      // nearer points of two paths are one sample
  double later_discount_per_s = 0.6;   // weights fall by e^(−this · t_k)
};

/// Where the vehicle wants to be: ring, visible regions, heights, corridor.
struct PlaceParams {
  double distance_low_m = 1.5;         // d_l
  double distance_high_m = 2.5;        // d_u
  double reserve_low_m = 0.3;          // kept beyond d_l, for what the vehicle needs to react
  double reserve_high_m = 0.3;         // kept short of d_u, for what it needs to catch up
  double distance_extra_m = 0.3;       // d_ε
  double ring_tolerance_m = 0.2;       // of the wanted distance, the middle of the band
  double margin_min_rad = 0.12;        // θ_0
  double margin_extra_rad = 0.4;       // θ_ε
  double margin_share_max = 0.7;       // margins take at most this part of a visible region
  double height_above_target_m = 0.1;  // wanted
  double height_search_m = 0.6;        // other levels, this far up and down, when that is not free
  double search_clearance_m = 0.02;    // of the path, beyond the vehicle's radius
  int search_expansions_max = 2000;    // of all searches of one plan
  int sector_steps = 24;               // rays in a quarter turn
  double corridor_clearance_m = 0.03;  // of the corridor, beyond the radius, where there is room
  double corridor_reach_m = 1.2;       // of a polytope, beyond its segment
  double corridor_height_m = 0.5;      // the same, up and down
  double segment_max_m = 2.5;          // length of path in one polytope
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
  double fov_margin_rad = 0.2;     // the plan keeps the target this far inside
  bool yaw_ahead = true;           // yaw follows the expected target; else where it is now
  double yaw_effort = 0.002;       // weight of (rad/s²)² against rad² of bearing error
  double search_look_s = 1.0;      // where a target was lost, the camera looks there for so long
  double search_rate_rad_s = 1.2;  // then turns round
  double search_speed_m_s = 1.0;   // greatest speed of the vehicle in a search
  bool gimbal = false;             // plan gimbal_pitch as well
  double gimbal_rate_max_rad_s = 2.0;
  double gimbal_acceleration_max_rad_s2 = 10.0;
};

struct PlanningParams {
  HorizonParams horizon;
  PlaceParams place;
  ViewParams view;
  FlightLimits limits;
  OptimizerParams optimizer;
  CheckParams check;

  double distance_wanted_m() const { return 0.5 * (place.kept_low_m() + place.kept_high_m()); }
  double path_clearance_m() const { return check.vehicle_radius_m + place.search_clearance_m; }
};
/// Every row of every part, in the order above.
ParamRows rows(PlanningParams& params);

}  // namespace foretrack
