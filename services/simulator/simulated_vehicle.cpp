// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/simulated_vehicle.hpp"

#include "services/convert/geometry.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_home.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kMaxCommands = 16;

}  // namespace

SimulatedVehicle::SimulatedVehicle(Node& node, SimulatorState state)
    : state_(std::move(state)),
      heartbeat_(node),
      setpoint_(node),
      command_(node),
      ack_(node),
      world_(node, state_.scenario, state_.world) {}

bool SimulatedVehicle::flies_offboard() const {
  return output().autopilot.armed && output().autopilot.mode == FlightMode::kOffboard;
}

void SimulatedVehicle::step(double dt_s, bool tells) {
  const SimulatorOutput& out = simulate(state_, take_input(), dt_s);
  if (out.answer && tells) answer(*out.answer);
  if (!commands_.empty()) commands_.pop_front();
  if (tells) world_.publish(out);
}

void SimulatedVehicle::answer(CommandResult result) {
  to_ack(commands_.front(), result, state_.output.now_s, ack_.sample());
  ack_.write();
}

AutopilotInput SimulatedVehicle::take_input() {
  AutopilotInput input;
  input.heartbeat = heartbeat_.take_newest() != nullptr;
  input.setpoint = setpoint_.take_newest_as(
      [](const px4_msgs::msg::TrajectorySetpoint& message) { return from_idl(message); });
  take_command(input);
  return input;
}

// One a step, in the order of their arrival; others wait.
void SimulatedVehicle::take_command(AutopilotInput& input) {
  command_.take_each([this](const px4_msgs::msg::VehicleCommand& message) {
    if (commands_.size() < kMaxCommands) commands_.push_back(message);
  });
  if (commands_.empty()) return;
  const auto& first = commands_.front();
  const bool is_ours = first.target_system() == state_.autopilot.status.system_id;
  if (const auto home = home_asked_by(first); home && is_ours) {
    input.home_enu_m = local_of(kOriginOfWorlds, *home);
    return;
  }
  const auto command = from_idl(first);
  if (command) {
    input.command = *command;
    return;
  }
  command_.refuse(command.fault());
  if (is_ours) answer(CommandResult::kUnsupported);
}

}  // namespace foretrack
