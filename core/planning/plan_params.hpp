// SPDX-License-Identifier: Apache-2.0
// Parameters of the whole planning stage.
#pragma once

#include <algorithm>

#include "core/common/params.hpp"
#include "core/planning/motion/check_trajectory.hpp"
#include "core/planning/motion/flight_limits.hpp"
#include "core/planning/motion/keep_clear.hpp"
#include "core/planning/optimize/optimize_trajectory.hpp"
#include "core/planning/search/search_params.hpp"

namespace foretrack {

/// Which target positions are planned for, and from which state.
struct HorizonParams {
  double horizon_s = 3.0;       ///< prediction horizon that is planned for (T_p)
  double step_s = 0.2;          ///< time between predicted positions (Δ)
  double replan_lead_s = 0.02;  ///< a new plan joins the flown one this far ahead
  /// further from the flown trajectory, a plan starts where the vehicle is
  double restart_distance_m = 0.6;
  double plan_period_s = 0.03;   ///< least time between two replans
  double plan_latest_s = 0.05;   ///< without new data it is replanned after that long
  double vehicle_stale_s = 0.5;  ///< an older vehicle state is not planned from
  double target_stale_s = 0.6;   ///< an older target state is lost, an older prediction is not used
  double map_stale_s = 2.0;      ///< an older map is none, unless it is known (stamp 0)
  double search_s = 60.0;        ///< a lost target is searched for so long; then it is waited for
  double target_radius_m = 0.35;  ///< so near the person, occupied cells do not block sight
  bool hedging = true;            ///< expectation over the intention paths; else the likeliest
  /// turn scores widen the margins of sight, deceleration the distance
  bool intention_margins = true;
  double path_probability_min = 0.06;  ///< less likely paths are not hedged against
  double merge_distance_m = 0.12;      ///< nearer points of two paths are one sample
  double later_discount_per_s = 0.6;   ///< decay of the samples' weights with time
};

/// Where the vehicle wants to be: ring, visible regions, heights, corridor.
struct PlaceParams {
  double distance_low_m = 1.5;   ///< least distance to the target (d_l)
  double distance_high_m = 2.5;  ///< greatest distance (d_u)
  /// kept beyond the least distance, for what the vehicle needs to react
  double reserve_low_m = 0.3;
  /// kept short of the greatest distance, for what the vehicle needs to catch up
  double reserve_high_m = 0.3;
  /// added to the least distance as deceleration grows likely (d_ε)
  double distance_extra_m = 0.3;
  double ring_tolerance_m = 0.2;       ///< half width of the ring that a waypoint search stops on
  double margin_min_rad = 0.12;        ///< margin of sight on each side (θ_0)
  double margin_extra_rad = 0.4;       ///< added to it as a turn grows likely (θ_ε)
  double margin_share_max = 0.7;       ///< part of a visible region that the margins may take
  double height_above_target_m = 0.1;  ///< wanted height of the vehicle above the target's centre
  double height_search_m = 0.6;      ///< levels up to so far from it are tried when it is not free
  double search_clearance_m = 0.02;  ///< clearance of the path beyond the vehicle's radius
  int search_expansions_max = 2000;  ///< expansions of all waypoint searches of one plan
  int sector_steps = 24;             ///< rays in a quarter turn of a visible region
  /// of the corridor, beyond the vehicle's radius, where there is room
  double corridor_clearance_m = 0.03;
  double corridor_reach_m = 1.2;   ///< reach of a polytope beyond its segment, horizontally
  double corridor_height_m = 0.5;  ///< the same, up and down
  double segment_max_m = 2.5;      ///< length of path in one polytope
  int polytopes_max = 5;           ///< polytopes of one corridor (M_F)

  double kept_low_m() const { return distance_low_m + reserve_low_m; }
  double kept_high_m() const { return std::max(distance_high_m - reserve_high_m, kept_low_m()); }
  /// d̂_l: a likely deceleration narrows the band from below.
  double kept_low_m(double score_decelerate) const {
    return std::min(kept_low_m() + distance_extra_m * score_decelerate, kept_high_m());
  }
};

/// Field of view and what the camera's axes may do.
struct ViewParams {
  double fov_horizontal_rad = 1.5708;  ///< angle of view
  double fov_margin_rad = 0.2;  ///< the yaw plan keeps the target so far inside the angle of view
  /// yaw follows where the target is expected; else it points to where the target is
  bool yaw_ahead = true;
  double yaw_effort = 0.002;  ///< weight of squared yaw acceleration against squared bearing error
  double search_speed_m_s = 1.5;  ///< the vehicle searches no faster where the person may be near
  bool gimbal = false;            ///< plan the pitch of a gimbal as well
  double gimbal_rate_max_rad_s = 2.0;            ///< greatest pitch rate of the gimbal
  double gimbal_acceleration_max_rad_s2 = 10.0;  ///< greatest pitch acceleration of the gimbal
};

/// How an operator's framing is taken on.
struct FramingParams {
  double framing_change_m_s = 0.4;  ///< a distance or height that is ordered is come to so fast
  /// the vehicle goes round the person so fast to where it is ordered, at most
  double framing_around_m_s = 0.8;
  double seat_around_m_s = 2.0;            ///< the same, to its seat in a fleet
  double seat_change_m_s = 1.2;            ///< the distance of a seat in a fleet is come to so fast
  double framing_half_angle_rad = 0.25;    ///< a bearing that is ordered is kept to within this
  double framing_elevation_max_rad = 0.5;  ///< from no steeper the person is looked at
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
  SearchParams search;
  FramingParams framing;

  double distance_wanted_m() const { return 0.5 * (place.kept_low_m() + place.kept_high_m()); }
  double path_clearance_m() const { return check.vehicle_radius_m + place.search_clearance_m; }
};
/// Every row of every part, in the order above.
ParamRows rows(PlanningParams& params);

}  // namespace foretrack
