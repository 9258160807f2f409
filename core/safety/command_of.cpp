// SPDX-License-Identifier: Apache-2.0
#include "core/safety/command_of.hpp"

namespace foretrack {

std::optional<AutopilotCommand> command_of(AutopilotRequest request, int system_id) {
  AutopilotCommand command{.target_system = system_id};
  switch (request) {
    case AutopilotRequest::kArm:
      command.kind = CommandKind::kArm;
      break;
    case AutopilotRequest::kOffboard:
      command.mode = FlightMode::kOffboard;
      break;
    case AutopilotRequest::kReturn:
      command.mode = FlightMode::kReturn;
      break;
    case AutopilotRequest::kLand:
      command.mode = FlightMode::kLand;
      break;
    case AutopilotRequest::kTakeOff:
      command.mode = FlightMode::kTakeOff;
      break;
    case AutopilotRequest::kPilot:
      command.mode = FlightMode::kPilot;
      break;
    case AutopilotRequest::kHold:
      command.mode = FlightMode::kHold;
      break;
    default:
      return std::nullopt;
  }
  return command;
}

}  // namespace foretrack
