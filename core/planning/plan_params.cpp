// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan_params.hpp"

#include "core/planning/optimize/optimize_trajectory.hpp"

namespace foretrack {
namespace {

ParamRows rows(HorizonParams& p) {
  return {
      {"horizon_s", &p.horizon_s, "s", 0.4, 6.0, "prediction horizon that is planned for (T_p)"},
      {"step_s", &p.step_s, "s", 0.05, 1.0, "time between predicted positions (Δ)"},
      {"replan_lead_s", &p.replan_lead_s, "s", 0.0, 0.5,
       "a new plan joins the flown one this far ahead"},
      {"restart_distance_m", &p.restart_distance_m, "m", 0.05, 5.0,
       "further from the flown trajectory, a plan starts where the vehicle is"},
      {"plan_period_s", &p.plan_period_s, "s", 0.01, 1.0, "least time between two replans"},
      {"plan_latest_s", &p.plan_latest_s, "s", 0.01, 1.0,
       "without new data it is replanned after that long"},
      {"vehicle_stale_s", &p.vehicle_stale_s, "s", 0.05, 5.0,
       "an older vehicle state is not planned from"},
      {"target_stale_s", &p.target_stale_s, "s", 0.05, 10.0,
       "an older target state is lost, an older prediction is not used"},
      {"map_stale_s", &p.map_stale_s, "s", 0.1, 60.0,
       "an older map is none, unless it is known (stamp 0)"},
      {"search_s", &p.search_s, "s", 0.0, 3600.0,
       "a lost target is searched for so long; then it is waited for"},
      {"target_radius_m", &p.target_radius_m, "m", 0.0, 1.0,
       "so near the person, occupied cells do not block sight"},
      {"hedging", &p.hedging, "", 0, 0, "expectation over the intention paths; else the likeliest"},
      {"intention_margins", &p.intention_margins, "", 0, 0,
       "turn scores widen the margins of sight, deceleration the distance"},
      {"path_probability_min", &p.path_probability_min, "", 0.0, 1.0,
       "less likely paths are not hedged against"},
      {"merge_distance_m", &p.merge_distance_m, "m", 0.0, 1.0,
       "nearer points of two paths are one sample"},
      {"later_discount_per_s", &p.later_discount_per_s, "1/s", 0.0, 5.0,
       "decay of the samples' weights with time"},
  };
}

ParamRows rows(PlaceParams& p) {
  return {
      {"distance_low_m", &p.distance_low_m, "m", 0.5, 20.0, "least distance to the target (d_l)"},
      {"distance_high_m", &p.distance_high_m, "m", 0.6, 30.0, "greatest distance (d_u)"},
      {"reserve_low_m", &p.reserve_low_m, "m", 0.0, 5.0,
       "kept beyond the least distance, for what the vehicle needs to react"},
      {"reserve_high_m", &p.reserve_high_m, "m", 0.0, 5.0,
       "kept short of the greatest distance, for what the vehicle needs to catch up"},
      {"distance_extra_m", &p.distance_extra_m, "m", 0.0, 5.0,
       "added to the least distance as deceleration grows likely (d_ε)"},
      {"ring_tolerance_m", &p.ring_tolerance_m, "m", 0.05, 2.0,
       "half width of the ring that a waypoint search stops on"},
      {"margin_min_rad", &p.margin_min_rad, "rad", 0.0, 1.0, "margin of sight on each side (θ_0)"},
      {"margin_extra_rad", &p.margin_extra_rad, "rad", 0.0, 1.5,
       "added to it as a turn grows likely (θ_ε)"},
      {"margin_share_max", &p.margin_share_max, "", 0.0, 0.95,
       "part of a visible region that the margins may take"},
      {"height_above_target_m", &p.height_above_target_m, "m", -2.0, 10.0,
       "wanted height of the vehicle above the target's centre"},
      {"height_search_m", &p.height_search_m, "m", 0.0, 5.0,
       "levels up to so far from it are tried when it is not free"},
      {"search_clearance_m", &p.search_clearance_m, "m", 0.0, 2.0,
       "clearance of the path beyond the vehicle's radius"},
      {"search_expansions_max", &p.search_expansions_max, "", 10, 100000,
       "expansions of all waypoint searches of one plan"},
      {"sector_steps", &p.sector_steps, "", 4, 180, "rays in a quarter turn of a visible region"},
      {"corridor_clearance_m", &p.corridor_clearance_m, "m", 0.0, 1.0,
       "of the corridor, beyond the vehicle's radius, where there is room"},
      {"corridor_reach_m", &p.corridor_reach_m, "m", 0.1, 5.0,
       "reach of a polytope beyond its segment, horizontally"},
      {"corridor_height_m", &p.corridor_height_m, "m", 0.1, 5.0, "the same, up and down"},
      {"segment_max_m", &p.segment_max_m, "m", 0.5, 10.0, "length of path in one polytope"},
      {"polytopes_max", &p.polytopes_max, "", 1, kPolytopesMax, "polytopes of one corridor (M_F)"},
  };
}

ParamRows rows(ViewParams& p) {
  return {
      {"fov_horizontal_rad", &p.fov_horizontal_rad, "rad", 0.2, 3.1, "angle of view"},
      {"fov_margin_rad", &p.fov_margin_rad, "rad", 0.0, 1.0,
       "the yaw plan keeps the target so far inside the angle of view"},
      {"yaw_ahead", &p.yaw_ahead, "", 0, 0,
       "yaw follows where the target is expected; else it points to where the target is"},
      {"yaw_effort", &p.yaw_effort, "s4", 1e-6, 1.0,
       "weight of squared yaw acceleration against squared bearing error"},
      {"search_speed_m_s", &p.search_speed_m_s, "m/s", 0.1, 20.0,
       "the vehicle searches no faster where the person may be near"},
      {"gimbal", &p.gimbal, "", 0, 0, "plan the pitch of a gimbal as well"},
      {"gimbal_rate_max_rad_s", &p.gimbal_rate_max_rad_s, "rad/s", 0.1, 10.0,
       "greatest pitch rate of the gimbal"},
      {"gimbal_acceleration_max_rad_s2", &p.gimbal_acceleration_max_rad_s2, "rad/s2", 0.1, 100.0,
       "greatest pitch acceleration of the gimbal"},
  };
}

ParamRows rows(FramingParams& p) {
  return {
      {"framing_change_m_s", &p.framing_change_m_s, "m/s", 0.01, 2.0,
       "a distance or height that is ordered is come to so fast"},
      {"framing_around_m_s", &p.framing_around_m_s, "m/s", 0.01, 3.0,
       "the vehicle goes round the person so fast to where it is ordered, at most"},
      {"framing_half_angle_rad", &p.framing_half_angle_rad, "rad", 0.05, 1.5,
       "a bearing that is ordered is kept to within this"},
      {"framing_elevation_max_rad", &p.framing_elevation_max_rad, "rad", 0.0, 1.3,
       "from no steeper the person is looked at"},
  };
}

void append(ParamRows& all, const ParamRows& part) {
  all.insert(all.end(), part.begin(), part.end());
}

}  // namespace

ParamRows rows(PlanningParams& p) {
  ParamRows all = rows(p.horizon);
  append(all, rows(p.place));
  append(all, rows(p.view));
  append(all, rows(p.limits));
  append(all, rows(p.optimizer));
  append(all, rows(p.check));
  append(all, rows(p.body));
  append(all, rows(p.search));
  append(all, rows(p.framing));
  return all;
}

}  // namespace foretrack
