// SPDX-License-Identifier: Apache-2.0
#include "core/common/moving_body.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {

Vec3 MovingBody::expected_at(double time_s) const {
  const double t_s = std::max(time_s - stamp_s, 0.0);
  if (place_count == 0 || step_s <= 0.0) return position_enu_m + t_s * velocity_enu_m_s;
  const int before = static_cast<int>(std::min(std::floor(t_s / step_s), place_count - 1.0));
  const Vec3& from = before == 0 ? position_enu_m : places_enu_m[before - 1];
  const Vec3& to = places_enu_m[before];
  return from + (to - from) * (t_s / step_s - before);
}

bool MovingBodies::add(const MovingBody& body) {
  if (count >= kCapacity) return false;
  bodies[count++] = body;
  return true;
}

const MovingBody* nearest_person(const MovingBodies& bodies, const Vec3& place_enu_m) {
  const MovingBody* nearest = nullptr;
  double least_m = 0.0;
  for (const MovingBody& body : bodies.all()) {
    const double away_m = (body.position_enu_m - place_enu_m).head<2>().norm();
    if (body.kind != BodyKind::kPerson || (nearest && away_m >= least_m)) continue;
    nearest = &body;
    least_m = away_m;
  }
  return nearest;
}

double gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const Vec3& cylinder_foot_enu_m,
             double cylinder_radius_m, double cylinder_height_m) {
  const Vec3 from_foot = ball_center_enu_m - cylinder_foot_enu_m;
  const double beside_m = from_foot.head<2>().norm() - cylinder_radius_m;
  const double above_m = std::max(from_foot.z() - cylinder_height_m, -from_foot.z());
  const double outside_m = std::hypot(std::max(beside_m, 0.0), std::max(above_m, 0.0));
  const double inside_m = std::min(std::max(beside_m, above_m), 0.0);
  return outside_m + inside_m - ball_radius_m;
}

double expected_gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const MovingBody& body,
                      double time_s) {
  return gap_m(ball_center_enu_m, ball_radius_m, body.expected_at(time_s), body.radius_m,
               body.height_m);
}

// Whatever it does, the body is in two discs: around its place (it is no faster than this) and
// around where its velocity would lead (it changes that no faster than this).
double least_gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const MovingBody& body,
                   double time_s, const BodyMotionBounds& bounds) {
  const double t_s = std::max(time_s - body.stamp_s, 0.0);
  const double speed_m_s = std::max(bounds.speed_m_s, body.velocity_enu_m_s.head<2>().norm());
  const double by_speed_m = gap_m(ball_center_enu_m, ball_radius_m, body.position_enu_m,
                                  body.radius_m + speed_m_s * t_s, body.height_m);
  const double by_acceleration_m =
      gap_m(ball_center_enu_m, ball_radius_m, body.position_enu_m + t_s * body.velocity_enu_m_s,
            body.radius_m + 0.5 * bounds.acceleration_m_s2 * t_s * t_s, body.height_m);
  return std::max(by_speed_m, by_acceleration_m);
}

}  // namespace foretrack
