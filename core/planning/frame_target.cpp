// SPDX-License-Identifier: Apache-2.0
#include "core/planning/frame_target.hpp"

#include <cmath>

namespace foretrack {
namespace {

constexpr double kWalks_m_s = 0.3;     // below it, the velocity has no direction
constexpr double kLongAgo_s = 0.5;     // so long after the last replan, nothing moved on meanwhile
constexpr double kMostLead_rad = 1.0;  // of the bearing before the vehicle

double moved(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

double bearing_of_vehicle(const PlanInput& in) {
  return yaw_of((in.vehicle.position_enu_m - in.target.position_enu_m).head<2>());
}

void begin(FramingState& s, const PlanInput& in, const PlanningParams& params) {
  s = {};
  s.active = true;
  s.at_s = in.now_s;
  s.distance_m = params.distance_wanted_m();
  s.height_m = params.place.height_above_target_m;
}

void notice_course(FramingState& s, const TargetState& target) {
  if (!target.usable()) return;
  if (target.speed_m_s() > kWalks_m_s)
    s.course_rad = yaw_of(target.velocity_enu_m_s.head<2>());
  else if (std::isnan(s.course_rad))
    s.course_rad = target.body_yaw_rad;
}

double wanted_or(double wanted, double otherwise) {
  return std::isnan(wanted) ? otherwise : wanted;
}

void move_distance_and_height(FramingState& s, const Framing& wanted, double dt_s,
                              const PlanningParams& params) {
  const PlaceParams& place = params.place;
  const double most_m =
      (wanted.is_seat ? params.framing.seat_change_m_s : params.framing.framing_change_m_s) * dt_s;
  s.distance_m =
      moved(s.distance_m, wanted_or(wanted.distance_m, params.distance_wanted_m()), most_m);
  const double steepest_m = s.distance_m * std::tan(params.framing.framing_elevation_max_rad);
  const double height_m = std::isnan(wanted.height_m)
                              ? place.height_above_target_m
                              : std::clamp(wanted.height_m, -steepest_m, steepest_m);
  s.height_m = moved(s.height_m, height_m, most_m);
}

// ENU; NaN: no bearing is wanted, or nobody knows where the person walks.
double fixed_bearing(const FramingState& s, const Framing& wanted) {
  return std::isnan(wanted.bearing_enu_rad) ? s.course_rad + wanted.bearing_rad
                                            : wanted.bearing_enu_rad;
}

// What is wanted leads the vehicle by no more than it can be seen to follow.
void move_bearing(FramingState& s, const PlanInput& in, double dt_s, const PlanningParams& params) {
  const Framing& wanted = in.framing;
  const bool circles = wanted.circling_rad_s != 0.0;
  const double fixed_rad = fixed_bearing(s, wanted);
  const bool fixed = !std::isnan(fixed_rad);
  const bool turned = s.turns;
  s.turns = in.target.usable() && (circles || fixed);
  if (!s.turns) return;
  WantedBearing& b = s.bearing;
  const double vehicle_rad = bearing_of_vehicle(in);
  if (!turned) s.gone_round_rad = 0.0;
  const double at_rad = turned ? b.at(in.now_s) : vehicle_rad;
  const double lead_rad =
      std::clamp(wrap_angle(at_rad - vehicle_rad), -kMostLead_rad, kMostLead_rad);
  b.at_s = in.now_s;
  b.now_rad = wrap_angle(vehicle_rad + lead_rad);
  b.circling_rad_s = wanted.circling_rad_s;
  b.rate_rad_s =
      (wanted.is_seat ? params.framing.seat_around_m_s : params.framing.framing_around_m_s) /
      s.distance_m;
  s.gone_round_rad = circles ? wrap_angle(s.gone_round_rad + wanted.circling_rad_s * dt_s) : 0.0;
  b.offset_rad = fixed ? wrap_angle(fixed_rad + s.gone_round_rad - b.now_rad) : 0.0;
}

// The band keeps its width, as far as it is safe.
void set_place(const FramingState& s, PlaceParams& place, double distance_wanted_m) {
  const double farther_m = s.distance_m - distance_wanted_m;
  const double least_m = place.distance_low_m;
  place.distance_low_m = std::max(place.distance_low_m + farther_m, least_m);
  place.distance_high_m =
      std::max(place.distance_high_m + farther_m,
               place.distance_low_m + place.reserve_low_m + place.reserve_high_m);
  place.height_above_target_m = s.height_m;
}

}  // namespace

const PlanningParams& frame_target(FramingState& s, const PlanInput& in,
                                   const PlanningParams& params) {
  if (!s.active && in.framing.is_free()) return params;
  if (!s.active) begin(s, in, params);
  const double since_s = in.now_s - s.at_s;
  const double dt_s = since_s < kLongAgo_s ? std::max(since_s, 0.0) : 0.0;
  s.at_s = in.now_s;
  notice_course(s, in.target);
  move_distance_and_height(s, in.framing, dt_s, params);
  move_bearing(s, in, dt_s, params);
  s.active = !in.framing.is_free() || s.distance_m != params.distance_wanted_m() ||
             s.height_m != params.place.height_above_target_m;
  s.params = params;
  set_place(s, s.params.place, params.distance_wanted_m());
  return s.params;
}

}  // namespace foretrack
