// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/person.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kStride_m = 1.4;           // two steps
constexpr double kHeadingSpeed_m_s = 0.15;  // slower than this, the path has no heading

bool wants_to_stand(const PersonParams& params, double now_s) {
  return std::any_of(params.stops.begin(), params.stops.end(), [&](const StandStill& stop) {
    return now_s >= stop.at_s && now_s < stop.at_s + stop.for_s;
  });
}

bool walks_backwards(const PersonParams& params, double walked_s) {
  return std::ranges::any_of(params.backward, [&](const BackwardSteps& steps) {
    return walked_s >= steps.from_s && walked_s < steps.to_s;
  });
}

// Pace changes at the acceleration limit, and only where the walk itself does not accelerate: both
// together would exceed the limit.
void update_pace(Person& person, const WalkPoint& here, double dt_s) {
  const double speed = here.velocity_m_s.norm();
  if (speed < kHeadingSpeed_m_s || here.acceleration_m_s2.norm() > 1e-6) return;
  const double wanted = wants_to_stand(person.params, person.state.stamp_s) ? 0.0 : 1.0;
  const double step = person.params.acceleration_m_s2 / speed * dt_s;
  person.pace += std::clamp(wanted - person.pace, -step, step);
}

// Swaying goes on with the walk: who stands holds still.
double chest_yaw_rad(const Person& person) {
  const PersonParams& p = person.params;
  const double phase_rad = 2.0 * kPi * p.shoulder_sway_hz * person.walked_s;
  const double sway_rad = p.shoulder_sway_rad * std::sin(phase_rad);
  return wrap_angle(person.course_rad + p.shoulder_offset_rad + sway_rad);
}

void turn_shoulders(Person& person, double dt_s) {
  const double ahead_s = person.walked_s + person.params.shoulder_lead_s;
  const Vec2 velocity_m_s = person.walk.at(ahead_s).velocity_m_s;
  if (velocity_m_s.norm() < kHeadingSpeed_m_s) return;
  const double back_rad = walks_backwards(person.params, ahead_s) ? kPi : 0.0;
  const double step = person.params.yaw_rate_rad_s * dt_s;
  double& course = person.course_rad;
  const double change_rad = wrap_angle(yaw_of(velocity_m_s) + back_rad - course);
  course = wrap_angle(course + std::clamp(change_rad, -step, step));
  person.state.body_yaw_rad = chest_yaw_rad(person);
}

}  // namespace

Person make_person(const PersonParams& params, Walk walk, double ground_z_m) {
  Person person{.params = params, .walk = std::move(walk), .state = {}};
  const WalkPoint start = person.walk.at(0.0);
  const double z = ground_z_m + torso_height_m(params.height_m);
  person.state.position_enu_m = {start.position_m.x(), start.position_m.y(), z};
  for (double t = 0.0; t < person.walk.duration_s(); t += 0.1) {
    const Vec2 velocity = person.walk.at(t).velocity_m_s;
    if (velocity.norm() < kHeadingSpeed_m_s) continue;
    person.course_rad = yaw_of(velocity);
    break;
  }
  person.state.body_yaw_rad = chest_yaw_rad(person);
  return person;
}

void advance(Person& person, double dt_s) {
  PersonState& s = person.state;
  s.stamp_s += dt_s;
  if (s.stamp_s <= person.params.start_s) return;
  const double pace_before = person.pace;
  update_pace(person, person.walk.at(person.walked_s), dt_s);
  person.walked_s += 0.5 * (pace_before + person.pace) * dt_s;
  turn_shoulders(person, dt_s);
  const WalkPoint here = person.walk.at(person.walked_s);
  const double pace_rate = (person.pace - pace_before) / dt_s;
  s.position_enu_m.head<2>() = here.position_m;
  s.velocity_enu_m_s.head<2>() = person.pace * here.velocity_m_s;
  s.acceleration_enu_m_s2.head<2>() =
      person.pace * person.pace * here.acceleration_m_s2 + pace_rate * here.velocity_m_s;
  s.stride_rad =
      wrap_angle(s.stride_rad + 2.0 * kPi * s.velocity_enu_m_s.norm() * dt_s / kStride_m);
}

}  // namespace foretrack
