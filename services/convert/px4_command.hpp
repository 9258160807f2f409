// SPDX-License-Identifier: Apache-2.0
// Commands to the flight controller, and its answers.
#pragma once

#include "core/common/vehicle.hpp"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleCommandAck.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// As an onboard computer of the vehicle that it is for.
void to_idl(const AutopilotCommand& command, double stamp_s, px4_msgs::msg::VehicleCommand& out);
/// What we ask for, or a fault: another command, or other parameters.
Converted<AutopilotCommand> from_idl(const px4_msgs::msg::VehicleCommand& in);

/// To the command's sender.
void to_ack(const px4_msgs::msg::VehicleCommand& command, CommandResult result, double stamp_s,
            px4_msgs::msg::VehicleCommandAck& out);
/// Whether it answers this command of ours: others send commands, too.
bool answers(const px4_msgs::msg::VehicleCommandAck& ack,
             const px4_msgs::msg::VehicleCommand& command);
/// Results that we do not know are failures.
CommandResult result_of(const px4_msgs::msg::VehicleCommandAck& ack);

}  // namespace foretrack
