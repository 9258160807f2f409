// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/simulate.hpp"

#include <algorithm>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr double kHullRadius_m = 0.25, kHullHeight_m = 0.2;  // of another vehicle
constexpr double kStartHeight_m = 1.5, kStartDistance_m = 2.0, kStartClearance_m = 0.5;

// What one vehicle's parts draw; people walk alike for all of a fleet.
std::uint64_t noise_seed(const Scenario& scenario, std::uint64_t part) {
  constexpr std::uint64_t kApart = 0x9E3779B97F4A7C15ULL;
  return seed_of(scenario, part) + kApart * static_cast<std::uint64_t>(scenario.vehicle_number);
}

std::string text_of(const Vec3& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) +
         ")";
}

bool fits(const World& world, const Vec3& p) {
  return world.contains(p) && clearance_m(world, p) >= kStartClearance_m;
}

// Behind the person at the usual distance; else round the person outwards from there, until a place
// is free and sees the person.
Vec3 free_start(const World& world, const Person& who, double ground_z) {
  const PersonState& person = who.state;
  const double behind = who.course_rad + kPi;
  for (const double distance_m : {kStartDistance_m, 1.5, 2.5, 3.0})
    for (int k = 0; k < 24; ++k) {
      const int steps = (k + 1) / 2;  // to either side in turn
      const double angle = behind + (k % 2 ? 1 : -1) * steps * kPi / 12.0;
      const Vec2 p = person.position_enu_m.head<2>() + distance_m * direction_of(angle);
      const Vec3 place(p.x(), p.y(), ground_z + kStartHeight_m);
      if (fits(world, place) && line_of_sight(world, place, person.position_enu_m)) return place;
    }
  throw std::invalid_argument("scenario: no free place for the vehicle near the target at " +
                              text_of(person.position_enu_m));
}

QuadrotorState place_vehicle(const Scenario& scenario, const World& world, const Person& person) {
  const auto seed = noise_seed(scenario, 1);
  if (scenario.vehicle_enu_m) {
    const Vec3& p = *scenario.vehicle_enu_m;
    if (!world.contains(p) || clearance_m(world, p) <= 0.0)
      throw std::invalid_argument("scenario: the vehicle's start " + text_of(p) +
                                  " is inside an obstacle or outside the bounds");
    return make_quadrotor(scenario.quadrotor, p, scenario.vehicle_yaw_rad, seed);
  }
  const Vec3 p = free_start(world, person, world.min_m.z());
  const double yaw = yaw_of(Vec2(person.state.position_enu_m.head<2>() - p.head<2>()));
  return make_quadrotor(scenario.quadrotor, p, yaw, seed);
}

void take_images(SimulatorState& state, double height_m) {
  const Scenario& scenario = state.scenario;
  SimulatorOutput& out = state.output;
  const bool wants_depth = scenario.map == MapSource::kDepth || scenario.depth_images;
  out.color = nullptr;
  out.depth = nullptr;
  if (state.color_camera) {
    out.color = image_color(*state.color_camera, out.vehicle, out.target, height_m);
    if (wants_depth && out.color) out.depth = depth_of(*state.color_camera, state.depth_camera);
    return;
  }
  out.observation = observe(state.landmark_camera, state.scene, out.vehicle, out.target, height_m);
  if (state.blind) out.observation.reset();
  if (!state.bystanders.empty())
    out.sightings = detect(state.people_detector, state.world, out.vehicle, state.bystanders,
                           cylinder_of(out.target, height_m));
  if (wants_depth)
    out.depth = image_depth(state.depth_camera, state.scene, out.vehicle, out.target, height_m);
}

std::vector<Person> bystanders_of(const Scenario& scenario, double ground_z_m) {
  std::vector<Person> people;
  for (const BystanderSpec& spec : scenario.bystanders)
    people.push_back(make_bystander(spec, ground_z_m, scenario.duration_s));
  return people;
}

PeopleDetectorParams detector_params_of(const Scenario& scenario) {
  const LandmarkCameraParams& camera = scenario.landmark_camera;
  return {.camera = camera.camera,
          .all_round = scenario.people_all_round,
          .delay_s = camera.delay_s,
          .range_max_m = camera.range_max_m};
}

std::vector<Bystander> rendered(const Scenario& scenario, const std::vector<Person>& people,
                                std::vector<std::shared_ptr<const PersonModel>> models) {
  if (models.size() != scenario.bystanders.size() ||
      std::find(models.begin(), models.end(), nullptr) != models.end())
    throw std::invalid_argument("make_simulator: " + std::to_string(scenario.bystanders.size()) +
                                " bystanders to render are needed");
  std::vector<Bystander> bystanders;
  for (std::size_t i = 0; i < models.size(); ++i)
    bystanders.push_back({std::move(models[i]), people[i]});
  return bystanders;
}

// All that a person does by the clock comes later.
void wait(Person& person, double dt_s) {
  person.params.start_s += dt_s;
  for (StandStill& stop : person.params.stops) stop.at_s += dt_s;
}

// What stands there, with the bystanders and the other vehicles where they are now.
void place_scene(SimulatorState& state) {
  if (state.bystanders.empty() && state.peers_enu_m.empty() &&
      state.scene.cylinders.size() == state.world.cylinders.size())
    return;
  place_people(state.scene, state.world.cylinders.size(), state.bystanders);
  for (const Vec3& peer : state.peers_enu_m)
    state.scene.cylinders.push_back({.center_m = peer.head<2>(),
                                     .radius_m = kHullRadius_m,
                                     .height_m = kHullHeight_m,
                                     .base_m = peer.z() - 0.5 * kHullHeight_m});
}

void walk_on(SimulatorState& state, double dt_s) {
  const auto pass = [&](Person& person) {
    if (state.people_wait) wait(person, dt_s);
    advance(person, dt_s);
  };
  pass(state.person);
  for (Person& other : state.bystanders) pass(other);
  place_scene(state);
  if (state.color_camera)
    for (std::size_t i = 0; i < state.bystanders.size(); ++i)
      state.color_camera->bystanders[i].person.state = state.bystanders[i].state;
}

void look(SimulatorState& state) {
  state.output.target = state.person.state;
  state.output.bystanders = state.bystanders;
  take_images(state, state.scenario.target.person.height_m);
}

}  // namespace

SimulatorState make_simulator(const Scenario& scenario, std::shared_ptr<const PersonModel> model,
                              std::vector<std::shared_ptr<const PersonModel>> bystanders) {
  World world = world_of(scenario);
  std::vector<Person> people = bystanders_of(scenario, world.min_m.z());
  Person person = make_person(scenario.target.person, walk_of(scenario, world), world.min_m.z());
  if (!world.contains(person.state.position_enu_m) ||
      clearance_m(world, person.state.position_enu_m) <= 0.0)
    throw std::invalid_argument("scenario: the target's start " +
                                text_of(person.state.position_enu_m) +
                                " is inside an obstacle or outside the bounds");
  QuadrotorState quadrotor = place_vehicle(scenario, world, person);
  if (scenario.parked) quadrotor.vehicle.position_enu_m.z() = 0.0;
  Autopilot autopilot = make_autopilot(scenario.autopilot, quadrotor.vehicle);
  SimulatorState state{scenario,
                       world,
                       world,
                       std::move(person),
                       std::move(people),
                       std::move(quadrotor),
                       std::move(autopilot),
                       make_landmark_camera(scenario.landmark_camera, noise_seed(scenario, 3)),
                       make_people_detector(detector_params_of(scenario), noise_seed(scenario, 6)),
                       make_depth_camera(scenario.depth_camera, noise_seed(scenario, 4)),
                       {},
                       {},
                       {}};
  if (scenario.color_images) {
    state.color_camera =
        make_color_camera({scenario.landmark_camera.camera, scenario.landmark_camera.rate_hz},
                          state.world, std::move(model));
    state.color_camera->bystanders = rendered(scenario, state.bystanders, std::move(bystanders));
  }
  state.output.vehicle = state.quadrotor.vehicle;
  state.output.autopilot = state.autopilot.status;
  state.output.target = state.person.state;
  return state;
}

const SimulatorOutput& simulate(SimulatorState& state, const AutopilotInput& input, double dt_s) {
  if (!(dt_s > 0.0)) throw std::invalid_argument("simulate: dt_s must be greater than 0");
  const Scenario& scenario = state.scenario;
  const Setpoint& setpoint =
      update_autopilot(state.autopilot, input, state.quadrotor.vehicle, dt_s);
  fly_setpoint(scenario.quadrotor, scenario.wind, state.quadrotor, setpoint,
               motors_turn(state.autopilot), dt_s);
  walk_on(state, dt_s);

  SimulatorOutput& out = state.output;
  out.now_s += dt_s;
  // One clock for all: sums of steps of 2 ms and of 10 ms differ in the last bits.
  state.quadrotor.vehicle.stamp_s = state.person.state.stamp_s = out.now_s;
  out.vehicle = state.quadrotor.vehicle;
  out.acceleration_enu_m_s2 = state.quadrotor.acceleration_enu_m_s2;
  out.autopilot = state.autopilot.status;
  out.autopilot.stamp_s = out.now_s;
  out.answer = state.autopilot.answer;
  out.trouble = state.autopilot.trouble;
  out.offboard_possible = may_fly_offboard(state.autopilot, out.now_s);
  out.home_enu_m = state.autopilot.home_enu_m;
  drain(out.battery, out.acceleration_enu_m_s2.z(), out.acceleration_enu_m_s2.head<2>().norm(),
        motors_turn(state.autopilot), dt_s);
  look(state);
  return out;
}

const SimulatorOutput& simulate_around(SimulatorState& state, const VehicleState& vehicle) {
  SimulatorOutput& out = state.output;
  const double dt_s = vehicle.stamp_s - out.now_s;
  if (!(dt_s > 0.0)) throw std::invalid_argument("simulate_around: a later stamp is expected");
  walk_on(state, dt_s);
  out.now_s = state.person.state.stamp_s = vehicle.stamp_s;
  out.vehicle = state.quadrotor.vehicle = vehicle;
  look(state);
  return out;
}

}  // namespace foretrack
