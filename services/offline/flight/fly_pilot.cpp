// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fly_pilot.hpp"

#include <cmath>

#include "services/offline/people/load_person.hpp"

namespace foretrack {

void write_truth(const SimulatorState& simulator, FlightRow& row) {
  const SimulatorOutput& out = simulator.output;
  const LandmarkCameraParams& camera = simulator.scenario.landmark_camera;
  row.now_s = out.now_s;
  row.vehicle = out.vehicle;
  row.acceleration_enu_m_s2 = out.acceleration_enu_m_s2;
  row.target = out.target;
  row.target_height_m = simulator.scenario.target.person.height_m;
  const Cylinder followed = cylinder_of(out.target, row.target_height_m);
  for (std::size_t i = 0; i < out.bystanders.size(); ++i) {
    const Person& other = out.bystanders[i];
    const bool seen = is_in_sight(simulator.people_detector.params, simulator.world, out.vehicle,
                                  out.bystanders, followed, i);
    row.bystanders.push_back({foot_enu_m(other.state, other.params.height_m),
                              other.state.velocity_enu_m_s, other.params.height_m, seen});
  }
  row.autopilot = out.autopilot;
  row.clearance_m = clearance_m(simulator.world, out.vehicle.position_enu_m);
  row.sight = sight_of(simulator.scene, camera.camera, out.vehicle, out.target, row.target_height_m,
                       camera.range_max_m);
}

FlightResult fly_pilot(const Scenario& scenario, const Pilot& pilot, const MetricParams& metrics,
                       const FlightOptions& options) {
  SimulatorState simulator = make_simulator(scenario, person_of(scenario), bystanders_of(scenario));
  GridMap known;
  if (scenario.map == MapSource::kKnown)
    known = known_map(simulator.world, scenario.map_resolution_m);
  const auto steps = static_cast<std::size_t>(std::lround(scenario.duration_s / options.step_s));
  FlightResult result{
      .scenario = scenario, .world = simulator.world, .rows = {}, .metrics = {}, .plan_ms = {}};
  result.rows.reserve(steps);
  AutopilotInput command;
  for (std::size_t i = 0; i < steps; ++i) {
    const SimulatorOutput& out = simulate(simulator, command, options.step_s);
    command = AutopilotInput{};
    FlightRow& row = result.rows.emplace_back();
    write_truth(simulator, row);
    pilot({out, known.empty() ? nullptr : &known, command, row, result.plan_ms});
    if (options.progress && !options.progress(out.now_s)) break;
  }
  result.metrics = metrics_of(result.rows, metrics);
  result.metrics.plan_ms = quantiles_of(result.plan_ms);
  return result;
}

}  // namespace foretrack
