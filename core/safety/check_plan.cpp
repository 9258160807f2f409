// SPDX-License-Identifier: Apache-2.0
#include "core/safety/check_plan.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kReaction_s = 0.4;  // from what is seen to the stop
constexpr double kNoWorse_m = 0.02;  // that a course nearer to a body may seem
constexpr double kFlees_m = 0.1;     // by which a way into the unseen must be farther from a body

PlanFault check_time(const PlannedTrajectory& plan, const Situation& now,
                     const PlanCheckParams& p) {
  const double ahead_s = plan.start_s - now.moment.stamp_now_s;
  if (ahead_s < -p.oldest_start_s) return PlanFault::kOldStart;
  if (ahead_s > p.farthest_start_s || plan.stamp_s > now.moment.stamp_now_s + p.farthest_start_s)
    return PlanFault::kFutureStart;
  const bool in_order = plan.id > now.last_id && now.moment.now_s + ahead_s >= now.last_start_s;
  return in_order ? PlanFault::kNone : PlanFault::kOutOfOrder;
}

Joint flown_at(const PlannedTrajectory& flown, double t_s) {
  return {flown.position(t_s), flown.velocity(t_s), flown.acceleration(t_s),
          flown.yaw.at(t_s).angle_rad};
}

PlanFault check_joint(const PlannedTrajectory& plan, const Situation& now,
                      const PlanCheckParams& p) {
  const double start_s = plan.start_s - now.moment.stamp_now_s + now.moment.now_s;
  if (now.flown && joins(plan, flown_at(*now.flown, start_s - now.flown->start_s), p.flown))
    return PlanFault::kNone;
  Joint carried_on = now.vehicle;
  carried_on.position_enu_m += (start_s - now.moment.now_s) * now.vehicle.velocity_enu_m_s;
  return joins(plan, carried_on, p.measured) ? PlanFault::kNone : PlanFault::kDoesNotJoin;
}

Course stop_of(const Situation& now, const PlanCheckParams& p) {
  return {now.vehicle.position_enu_m, now.vehicle.velocity_enu_m_s, p.braking_m_s2};
}

// While bodies are expected.
double gap_m(const Course& course, double begin_s, const MovingBody& body,
             const PlanCheckParams& p) {
  return least_expected_gap_m(course, body, p.clearances.vehicle_radius_m, begin_s,
                              p.body_horizon_s);
}

// A course is near a body if it comes nearer than the floor, and another one would not be as near:
// all the while that bodies are expected, as somebody may walk up to where a stop would end.
bool is_near(const Course& course, double begin_s, const MovingBody& body,
             std::span<const Course> others, const Situation& now, const PlanCheckParams& p,
             double until_s) {
  if (least_expected_gap_m(course, body, p.clearances.vehicle_radius_m, begin_s, until_s) >=
      p.clearances.body_m)
    return false;
  const double own_m = gap_m(course, begin_s, body, p);
  return std::ranges::any_of(others, [&](const Course& other) {
    return gap_m(other, now.moment.stamp_now_s, body, p) > own_m + kNoWorse_m;
  });
}

bool is_near_somebody(const Course& course, double begin_s, std::span<const Course> others,
                      const Situation& now, const PlanCheckParams& p, double until_s) {
  if (!now.around.bodies) return false;
  return std::ranges::any_of(now.around.bodies->all(), [&](const MovingBody& body) {
    return is_near(course, begin_s, body, others, now, p, until_s);
  });
}

// Whether it leads away from a body to which all others come nearer than the floor.
bool flees(const Course& course, double begin_s, std::span<const Course> others,
           const Situation& now, const PlanCheckParams& p) {
  if (!now.around.bodies) return false;
  return std::ranges::any_of(now.around.bodies->all(), [&](const MovingBody& body) {
    const double own_m = gap_m(course, begin_s, body, p);
    return std::ranges::all_of(others, [&](const Course& other) {
      const double other_m = gap_m(other, now.moment.stamp_now_s, body, p);
      return other_m < p.clearances.body_m && own_m > other_m + kFlees_m;
    });
  });
}

// What nobody has seen may hold something; somebody who walks into the vehicle is certain.
bool is_blocked(const Course& course, double begin_s, std::span<const Course> others,
                const Situation& now, const PlanCheckParams& p, const ObstacleRoom& room,
                double until_s) {
  if (!now.around.map) return false;
  const auto meets_at_s = [&](Passable passable) {
    return time_at_obstacle(course, *now.around.map, room, p.limits.acceleration_m_s2, until_s,
                            passable);
  };
  if (meets_at_s(Passable::kSeenFree) < 0.0) return false;
  return meets_at_s(Passable::kNotOccupied) >= 0.0 || !flees(course, begin_s, others, now, p);
}

PlanFault check_around(const PlannedTrajectory& plan, const Situation& now,
                       const PlanCheckParams& p) {
  const Course course(plan, 0.0);
  const double to_end_s = course.duration_s();
  if (!now.around.map && p.needs_map) return PlanFault::kNoMap;
  const Course stop = stop_of(now, p);
  const Course others[] = {
      stop, now.flown ? Course(*now.flown, now.moment.now_s - now.flown->start_s) : stop};
  const Clearances& c = p.clearances;
  const ObstacleRoom room{c.vehicle_radius_m, c.obstacle_m,
                          std::max(c.obstacle_m, c.obstacle_most_m), now.deviation};
  if (is_blocked(course, plan.start_s, others, now, p, room, to_end_s)) return PlanFault::kObstacle;
  if (time_out_of_bounds(course, now.around, c.bounds_m, to_end_s) >= 0.0 ||
      time_too_low(course, now.around, c.least_altitude_m, to_end_s) >= 0.0)
    return PlanFault::kBounds;
  return is_near_somebody(course, plan.start_s, others, now, p, p.body_horizon_s)
             ? PlanFault::kBody
             : PlanFault::kNone;
}

}  // namespace

PlanFault check_plan(const PlannedTrajectory& plan, const Situation& now,
                     const PlanCheckParams& params) {
  PlanFault fault = check_shape(plan);
  if (fault == PlanFault::kNone) fault = check_time(plan, now, params);
  if (fault == PlanFault::kNone) fault = check_limits(plan, params.limits);
  if (fault == PlanFault::kNone) fault = check_joint(plan, now, params);
  return fault == PlanFault::kNone ? check_around(plan, now, params) : fault;
}

PlanFault check_flown(const Situation& now, const PlanCheckParams& params) {
  const Course course(*now.flown, now.moment.now_s - now.flown->start_s);
  const double until_s =
      std::min(params.look_ahead_s, kReaction_s + stop_of(now, params).duration_s());
  const Course stop[] = {stop_of(now, params)};
  const double hull_m = params.clearances.vehicle_radius_m;
  if (is_blocked(course, now.moment.stamp_now_s, stop, now, params, {hull_m, hull_m, hull_m},
                 until_s))
    return PlanFault::kObstacle;
  if (time_out_of_bounds(course, now.around, 0.0, until_s) >= 0.0) return PlanFault::kBounds;
  return is_near_somebody(course, now.moment.stamp_now_s, stop, now, params, until_s)
             ? PlanFault::kBody
             : PlanFault::kNone;
}

}  // namespace foretrack
