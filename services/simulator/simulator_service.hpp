// SPDX-License-Identifier: Apache-2.0
// The simulator on the bus: vehicles with their autopilots and cameras at a steady pace.
#pragma once

#include <memory>
#include <vector>

#include "core/simulator/fleet_failures.hpp"
#include "rosgraph_msgs/msg/Clock.h"
#include "services/simulator/simulated_vehicle.hpp"

namespace foretrack {

struct SimulatorOptions {
  double speed = 1.0;    // simulated seconds in a second
  bool endless = false;  // goes on after the scenario's duration
  /// People stand until all vehicles fly in offboard mode, at most so long; the duration counts
  /// from then. A machine may take its time to start what is to follow.
  double people_wait_s = 0.0;
  // To be rendered, if the scenario has colour images.
  std::shared_ptr<const PersonModel> person = nullptr;
  std::vector<std::shared_ptr<const PersonModel>> bystanders = {};
};

/// Steps of 10 ms simulated time from 0, each announced on the clock topic after its data. It
/// makes up for some late steps, two at a time; under load it falls behind rather than leap. A
/// known map is published once, latched, with stamp 0.
///
/// A scenario's vehicles share its people and see each other. Each speaks by names of its own
/// (uav1, px4_1, system 2; …), as a participant of its own; the first is the service's.
class SimulatorService {
 public:
  /// Throws as make_simulator does; std::invalid_argument if the speed is not within 0.01 to 100.
  SimulatorService(Service& service, const Scenario& scenario, const SimulatorOptions& options,
                   Stop& stop);

 private:
  void add_vehicles(Service& service);
  void keep_pace();
  void step();
  void step(std::size_t vehicle);
  bool is_there(std::size_t vehicle) const;
  bool people_wait() const;

  Clock& clock_of_pace_;
  Stop& stop_;
  SimulatorOptions options_;
  Scenario scenario_;
  double period_s_ = 0.0, due_s_ = -1e18;  // steady clock, of the next step
  double now_s_ = 0.0;                     // simulated time
  double people_set_off_s_ = 0.0;
  bool people_wait_ = false;

  std::vector<std::unique_ptr<Node>> nodes_;  // of all vehicles but the first
  std::vector<std::unique_ptr<SimulatedVehicle>> vehicles_;
  std::vector<Presence> presences_;  // of a fleet's
  Writer<topics::Clock> clock_;
};

/// Until the stop is requested or the scenario is over. With several vehicles, the options' names
/// of vehicle and PX4 are not used.
void run_simulator(const ServiceOptions& options, const Scenario& scenario,
                   const SimulatorOptions& simulator, Stop& stop);

}  // namespace foretrack
