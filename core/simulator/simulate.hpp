// SPDX-License-Identifier: Apache-2.0
// The simulator's façade: world, person, vehicle, autopilot and cameras, one step at a time.
#pragma once

#include <optional>

#include "core/simulator/battery.hpp"
#include "core/simulator/color_camera.hpp"
#include "core/simulator/people_detector.hpp"
#include "core/simulator/scenario.hpp"

namespace foretrack {

/// What the simulated sensors and the flight controller say after a step.
struct SimulatorOutput {
  double now_s = 0.0;
  VehicleState vehicle;  // truth, which is also the odometry
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  AutopilotStatus autopilot;
  bool offboard_possible = false;       // on request
  bool trouble = false;                 ///< what a failsafe acts for
  Vec3 home_enu_m = Vec3::Zero();       // to where it returns
  std::optional<CommandResult> answer;  // to the step's command
  Battery battery;
  std::optional<TargetObservation> observation;  // delivered in this step; none with color images
  std::optional<BodySightings> sightings;        // the same of bystanders; none without any
  const ColorImage* color = nullptr;             // null: none in this step
  const DepthImage* depth = nullptr;             // null: none in this step
  PersonState target;                            // truth
  std::span<const Person> bystanders;            // truth; in the state, until the next step
};

/// A simulated flight at one moment.
struct SimulatorState {
  Scenario scenario;
  World world;  // what stands there
  World scene;  // the same with the bystanders where they are now: what cameras look through
  Person person;
  std::vector<Person> bystanders;
  QuadrotorState quadrotor;
  Autopilot autopilot;
  LandmarkCamera landmark_camera;
  PeopleDetector people_detector;
  DepthCamera depth_camera;
  std::optional<ColorCamera> color_camera;
  SimulatorOutput output;
  std::vector<Vec3> peers_enu_m;  ///< other vehicles: what cameras see of them, set by the caller
  bool blind = false;             ///< its camera sees nobody any more
  bool people_wait = false;       ///< nobody walks, and what they do by the clock is put off
};

/// At time 0: the person stands at the start, the vehicle hovers armed or is parked. Each part
/// draws its noise from a seed of its own. Throws std::invalid_argument for a scenario that cannot
/// be (start inside an obstacle or outside the bounds, no way to walk; color images without a
/// `person` to render, or without one for each bystander).
SimulatorState make_simulator(const Scenario& scenario,
                              std::shared_ptr<const PersonModel> person = nullptr,
                              std::vector<std::shared_ptr<const PersonModel>> bystanders = {});

/// Advances by dt_s (10 ms is usual). Autopilot, then vehicle, person, images. The output is also
/// in the state. Cost: about 20 µs for 10 ms; a depth image 2 ms more, a colour image 15 ms (and
/// depth comes from the same pass, at the next colour image when it is due).
const SimulatorOutput& simulate(SimulatorState& state, const AutopilotInput& input, double dt_s);

/// The same around a vehicle that flies by itself: until its stamp people walk on, and cameras see
/// from where it is. Throws std::invalid_argument unless its stamp is later than the last one.
const SimulatorOutput& simulate_around(SimulatorState& state, const VehicleState& vehicle);

}  // namespace foretrack
