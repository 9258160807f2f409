// SPDX-License-Identifier: Apache-2.0
// The simulator on the bus: vehicle, autopilot and cameras out, PX4's inputs in, at a steady pace.
#pragma once

#include <deque>

#include "core/simulator/simulate.hpp"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleCommandAck.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "services/simulator/world_writer.hpp"

namespace foretrack {

struct SimulatorOptions {
  double speed = 1.0;    // simulated seconds in a second
  bool endless = false;  // goes on after the scenario's duration
  /// People stand until the vehicle flies in offboard mode, at most so long; the duration counts
  /// from then. A machine may take its time to start what is to follow.
  double people_wait_s = 0.0;
  // To be rendered, if the scenario has colour images.
  std::shared_ptr<const PersonModel> person = nullptr;
  std::vector<std::shared_ptr<const PersonModel>> bystanders = {};
};

/// Steps of 10 ms simulated time from 0, each announced on the clock topic after its data. It
/// makes up for some late steps, two at a time; under load it falls behind rather than leap. A
/// known map is published once, latched, with stamp 0.
class SimulatorService {
 public:
  /// Throws as make_simulator does; std::invalid_argument if the speed is not within 0.01 to 100.
  SimulatorService(Service& service, const Scenario& scenario, const SimulatorOptions& options,
                   Stop& stop);

 private:
  void keep_pace();
  void step();
  bool people_wait() const;
  void answer(CommandResult result);
  AutopilotInput take_input();
  std::optional<AutopilotCommand> take_command();

  Clock& clock_of_pace_;
  Stop& stop_;
  SimulatorOptions options_;
  SimulatorState state_;
  double period_s_ = 0.0, due_s_ = -1e18;  // steady clock, of the next step
  double people_set_off_s_ = 0.0;          // simulated time

  Reader<topics::Px4OffboardControlMode> heartbeat_;
  Reader<topics::Px4TrajectorySetpoint> setpoint_;
  Reader<topics::Px4VehicleCommand> command_;
  std::deque<px4_msgs::msg::VehicleCommand> commands_;  // the first is the step's
  Writer<topics::Px4VehicleCommandAck> ack_;
  Writer<topics::Clock> clock_;
  WorldWriter world_;
};

/// Until the stop is requested or the scenario is over.
void run_simulator(const ServiceOptions& options, const Scenario& scenario,
                   const SimulatorOptions& simulator, Stop& stop);

}  // namespace foretrack
