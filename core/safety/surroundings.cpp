// SPDX-License-Identifier: Apache-2.0
#include "core/safety/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "core/common/ground.hpp"

namespace foretrack {
namespace {

constexpr double kLook_s = 0.02;
constexpr double kLeave_m = 1.0;    // within which what begins too near has left
constexpr double kInward_m = 0.05;  // by which numbers may make a place seem farther outside

double distance_to_edge_m(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double along =
      std::clamp((p - a).dot(edge) / std::max(edge.squaredNorm(), 1e-12), 0.0, 1.0);
  return (a + along * edge - p).norm();
}

// Positive inside: the crossings of a ray to the east are counted.
double room_in_fence_m(const FlightBounds& bounds, const Vec2& p) {
  double nearest_m = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (int i = 0; i < bounds.corner_count; ++i) {
    const auto& from = bounds.corners_enu_m[i];
    const auto& to = bounds.corners_enu_m[(i + 1) % bounds.corner_count];
    const Vec2 a(from.x_m, from.y_m), b(to.x_m, to.y_m);
    nearest_m = std::min(nearest_m, distance_to_edge_m(p, a, b));
    const bool spans = (a.y() > p.y()) != (b.y() > p.y());
    if (spans && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside ? nearest_m : -nearest_m;
}

// The first look at which the room is less than that, and less than at the begin; −1: none.
template <class Room>
double time_without_room(const Course& course, double until_s, double least_m, Room&& room_at) {
  const double end_s = std::min(until_s, course.duration_s());
  least_m = std::min(least_m, room_at(course.position(0.0)) - kInward_m);
  for (double t_s = 0.0;; t_s = std::min(t_s + kLook_s, end_s)) {
    if (room_at(course.position(t_s)) < least_m) return t_s;
    if (t_s >= end_s) return -1.0;
  }
}

}  // namespace

Vec3 over_ground(const GateSurroundings& around, const Vec3& place_enu_m) {
  const std::optional<double> seen_m =
      around.map ? ground_below_m(*around.map, place_enu_m) : std::nullopt;
  return place_enu_m - seen_m.value_or(around.ground_m) * Vec3::UnitZ();
}

double ObstacleRoom::at_m(double speed_m_s, double acceleration_m_s2) const {
  if (!deviation) return least_m;
  return std::clamp(hull_m + deviation->bound_m(speed_m_s, acceleration_m_s2), least_m, most_m);
}

double room_m(const FlightBounds& bounds, const Vec3& place_over_ground_m) {
  const double z = place_over_ground_m.z();
  const double room = std::min(z - bounds.altitude_min_m, bounds.altitude_max_m - z);
  return bounds.corner_count == 0
             ? room
             : std::min(room, room_in_fence_m(bounds, place_over_ground_m.head<2>()));
}

Course::Course(const PlannedTrajectory& plan, double from_s)
    : plan_(&plan), from_s_(from_s), duration_s_(std::max(plan.duration_s() - from_s, 0.0)) {}

Course::Course(const Vec3& position_enu_m, const Vec3& velocity_enu_m_s, double braking_m_s2)
    : duration_s_(velocity_enu_m_s.norm() / braking_m_s2),
      position_enu_m_(position_enu_m),
      velocity_enu_m_s_(velocity_enu_m_s),
      braking_m_s2_(braking_m_s2) {}

Vec3 Course::position(double t_s) const {
  if (plan_) return plan_->position(from_s_ + t_s);
  const double t = std::min(t_s, duration_s_);
  return position_enu_m_ + (t - 0.5 * t * t / std::max(duration_s_, 1e-9)) * velocity_enu_m_s_;
}

double Course::speed(double t_s) const {
  if (plan_) return plan_->velocity(from_s_ + t_s).norm();
  return braking_m_s2_ * std::max(duration_s_ - t_s, 0.0);
}

double Course::acceleration(double t_s) const {
  return plan_ ? plan_->acceleration(from_s_ + t_s).norm() : braking_m_s2_;
}

double time_at_obstacle(const Course& course, const GridMap& map, const ObstacleRoom& room,
                        double acceleration_m_s2, double until_s, Passable passable) {
  const double step_m = 0.25 * map.resolution_m, diagonal_m = 1.7321 * map.resolution_m;
  const double end_s = std::min(until_s, course.duration_s());
  const Vec3 start = course.position(0.0);
  const double start_m = map.clearance_m(start, passable);
  bool leaving = true;
  const double leaving_least_m =
      std::max(start_m - 0.5 * map.resolution_m, start_m < room.least_m ? 0.0 : room.least_m);
  for (double t_s = 0.0;;) {
    const Vec3 p = course.position(t_s);
    const double clear_m = map.clearance_m(p, passable);
    const double asked_m = room.at_m(course.speed(t_s), course.acceleration(t_s));
    leaving = leaving && clear_m < asked_m && (p - start).norm() <= kLeave_m;
    const double least_m = leaving ? leaving_least_m : asked_m;
    const bool enters = start_m > 0.0 && clear_m <= 0.0;
    if (clear_m < least_m || enters) return t_s;
    if (t_s >= end_s) return -1.0;
    // Beyond its edge, the map knows nothing.
    const Vec3 from_low = p - map.origin_enu_m;
    const Vec3 from_high = map.resolution_m * map.size.cast<double>() - from_low;
    const double free_m =
        std::min({clear_m - room.most_m - diagonal_m, from_low.minCoeff(), from_high.minCoeff()});
    const double move_m = std::max(free_m, step_m), speed_m_s = course.speed(t_s);
    // v t + a t² / 2 = move, in the form without cancellation.
    t_s += 2.0 * move_m /
           (speed_m_s + std::sqrt(speed_m_s * speed_m_s + 2.0 * acceleration_m_s2 * move_m));
    t_s = std::min(t_s, end_s);
  }
}

double time_out_of_bounds(const Course& course, const GateSurroundings& around, double bounds_m,
                          double until_s) {
  return time_without_room(course, until_s, bounds_m, [&](const Vec3& place) {
    return room_m(around.bounds, over_ground(around, place));
  });
}

double time_too_low(const Course& course, const GateSurroundings& around, double least_altitude_m,
                    double until_s) {
  return time_without_room(course, until_s, least_altitude_m,
                           [&](const Vec3& place) { return over_ground(around, place).z(); });
}

double least_expected_gap_m(const Course& course, const MovingBody& body, double vehicle_radius_m,
                            double begin_s, double until_s) {
  double least = std::numeric_limits<double>::infinity();
  const int looks = static_cast<int>(std::ceil(until_s / kLook_s));
  for (int i = 0; i <= looks; ++i) {
    const double t_s = i * kLook_s;
    least = std::min(least,
                     expected_gap_m(course.position(t_s), vehicle_radius_m, body, begin_s + t_s));
  }
  return least;
}

}  // namespace foretrack
