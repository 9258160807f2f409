// SPDX-License-Identifier: Apache-2.0
// One simulated vehicle on the bus: PX4's inputs in, its sensors, autopilot and truth out.
#pragma once

#include <deque>
#include <optional>

#include "core/simulator/simulate.hpp"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleCommandAck.h"
#include "services/simulator/world_writer.hpp"

namespace foretrack {

class SimulatedVehicle {
 public:
  /// Speaks by the node's names.
  SimulatedVehicle(Node& node, SimulatorState state);

  SimulatorState& state() { return state_; }
  const SimulatorOutput& output() const { return state_.output; }
  bool flies_offboard() const;
  /// Takes what came, simulates, and tells, if it is there to be heard.
  void step(double dt_s, bool tells);

 private:
  void answer(CommandResult result);
  AutopilotInput take_input();
  void take_command(AutopilotInput& input);

  SimulatorState state_;
  Reader<topics::Px4OffboardControlMode> heartbeat_;
  Reader<topics::Px4TrajectorySetpoint> setpoint_;
  Reader<topics::Px4VehicleCommand> command_;
  std::deque<px4_msgs::msg::VehicleCommand> commands_;  // the first is the step's
  Writer<topics::Px4VehicleCommandAck> ack_;
  WorldWriter world_;
};

}  // namespace foretrack
