// SPDX-License-Identifier: Apache-2.0
// The closed loop of a lock-step flight: the simulator and whoever flies, in one thread.
#pragma once

#include <functional>
#include <vector>

#include "core/simulator/simulate.hpp"
#include "services/offline/flight/metrics.hpp"

namespace foretrack {

struct FlightOptions {
  double step_s = 0.01;
  /// Called after each step with the flight's time; false ends the flight.
  std::function<bool(double now_s)> progress;
};

/// What a pilot is given at each step, and what it fills in: the command, and its part of the row
/// (belief and decision). plan_ms: the wall time of a replan, if there was one.
struct PilotStep {
  const SimulatorOutput& simulator;
  const GridMap* known_map;  // null: the map is to be built from depth images
  AutopilotInput& command;
  FlightRow& row;
  std::vector<double>& plan_ms;
};
using Pilot = std::function<void(PilotStep)>;

struct FlightResult {
  Scenario scenario;
  World world;  // as it was flown in
  std::vector<FlightRow> rows;
  Metrics metrics;
  std::vector<double> plan_ms;  // wall time of each step that replanned; not part of the log
};

/// What is true of the vehicle and of people at this moment.
void write_truth(const SimulatorState& simulator, FlightRow& row);

/// Flies the scenario for its duration. What a pilot commands reaches the autopilot in the next
/// step. Throws std::invalid_argument for a scenario that cannot be.
FlightResult fly_pilot(const Scenario& scenario, const Pilot& pilot, const MetricParams& metrics,
                       const FlightOptions& options = {});

}  // namespace foretrack
