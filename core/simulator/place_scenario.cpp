// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/place_scenario.hpp"

#include <cmath>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr double kQuarter_rad = 0.5 * kPi;
constexpr double kHeight_m = 1.5, kClearance_m = 0.5;  // where the vehicle will fly at first

// About z by quarters, then along the ground; exact.
struct Shift {
  int quarters = 0;
  Vec3 by_m = Vec3::Zero();

  Vec2 turned(const Vec2& v) const {
    Vec2 out = v;
    for (int i = 0; i < quarters; ++i) out = Vec2(-out.y(), out.x());
    return out;
  }
  Vec3 turned(const Vec3& v) const {
    const Vec2 xy = turned(Vec2(v.head<2>()));
    return {xy.x(), xy.y(), v.z()};
  }
  Vec3 moved(const Vec3& p) const { return turned(p) + by_m; }
  Vec2 moved(const Vec2& p) const { return turned(p) + by_m.head<2>(); }
  double turned_rad(double yaw_rad) const { return wrap_angle(yaw_rad + quarters * kQuarter_rad); }
};

void move_corners(const Shift& shift, Vec3& min_m, Vec3& max_m) {
  const Vec3 a = shift.moved(min_m), b = shift.moved(max_m);
  min_m = a.cwiseMin(b);
  max_m = a.cwiseMax(b);
}

void move(const Shift& shift, World& world) {
  move_corners(shift, world.min_m, world.max_m);
  for (Box& box : world.boxes) move_corners(shift, box.min_m, box.max_m);
  for (Cylinder& cylinder : world.cylinders) {
    cylinder.center_m = shift.moved(cylinder.center_m);
    cylinder.base_m += shift.by_m.z();
  }
}

void move(const Shift& shift, Person& person) {
  for (WalkPiece& piece : person.walk.pieces) {
    for (Vec2& coefficient : piece.coefficients_m) coefficient = shift.turned(coefficient);
    piece.coefficients_m[0] += shift.by_m.head<2>();
  }
  PersonState& state = person.state;
  state.position_enu_m = shift.moved(state.position_enu_m);
  state.velocity_enu_m_s = shift.turned(state.velocity_enu_m_s);
  state.body_yaw_rad = shift.turned_rad(state.body_yaw_rad);
  person.course_rad = shift.turned_rad(person.course_rad);
}

void move(const Shift& shift, SimulatorState& state) {
  move(shift, state.world);
  move(shift, state.scene);
  move(shift, state.person);
  for (Person& person : state.bystanders) move(shift, person);
  state.output.target = state.person.state;
  if (!state.color_camera) return;
  ColorCamera& camera = *state.color_camera;
  auto bystanders = std::move(camera.bystanders);
  camera = make_color_camera(camera.params, state.world, camera.person);
  for (std::size_t i = 0; i < bystanders.size(); ++i) bystanders[i].person = state.bystanders[i];
  camera.bystanders = std::move(bystanders);
}

// The vehicle's place in the scenario as it is now, straight behind the person by its own heading.
bool is_free(const SimulatorState& state, const Vec2& place_m) {
  const Vec3 place(place_m.x(), place_m.y(), state.world.min_m.z() + kHeight_m);
  return state.world.contains(place) && clearance_m(state.world, place) >= kClearance_m &&
         line_of_sight(state.world, place, state.person.state.position_enu_m);
}

// Quarters in the order in which they leave the vehicle's heading near the person's course.
std::array<int, 4> quarters_by_nearness(double heading_rad, double course_rad) {
  const int nearest = static_cast<int>(std::lround((heading_rad - course_rad) / kQuarter_rad));
  const auto quarter = [](int i) { return ((i % 4) + 4) % 4; };
  return {quarter(nearest), quarter(nearest + 1), quarter(nearest - 1), quarter(nearest + 2)};
}

}  // namespace

void place_scenario(SimulatorState& state, const VehicleState& vehicle) {
  const Vec2 person_m = state.person.state.position_enu_m.head<2>();
  for (const int quarters : quarters_by_nearness(vehicle.yaw_rad(), state.person.course_rad))
    for (const double distance_m : {2.0, 1.5, 2.5, 3.0}) {
      const Vec2 ahead = direction_of(vehicle.yaw_rad() - quarters * kQuarter_rad);
      const Vec2 place_m = person_m - distance_m * ahead;
      if (!is_free(state, place_m)) continue;
      Shift shift{quarters};
      const Vec2 by_m = vehicle.position_enu_m.head<2>() - shift.turned(place_m);
      shift.by_m = {by_m.x(), by_m.y(), -state.world.min_m.z()};
      return move(shift, state);
    }
  throw std::invalid_argument("scenario '" + state.scenario.name +
                              "': no free place from which the vehicle, as it is headed, sees the "
                              "person straight ahead");
}

void begin_at(SimulatorState& state, double now_s) {
  const auto put_off = [now_s](Person& person) {
    person.state.stamp_s += now_s;
    person.params.start_s += now_s;
    for (StandStill& stop : person.params.stops) stop.at_s += now_s;
  };
  put_off(state.person);
  for (Person& person : state.bystanders) put_off(person);
  state.output.now_s += now_s;
  state.landmark_camera.next_image_s += now_s;
  state.people_detector.next_image_s += now_s;
  state.depth_camera.next_image_s += now_s;
  if (state.color_camera) state.color_camera->next_image_s += now_s;
}

}  // namespace foretrack
