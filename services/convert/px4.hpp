// SPDX-License-Identifier: Apache-2.0
// The flight controller's messages: NED and FRD, microseconds of its clock, NaN = not controlled.
#pragma once

#include "core/common/vehicle.hpp"
#include "px4_msgs/msg/ManualControlSetpoint.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const Setpoint& setpoint, px4_msgs::msg::TrajectorySetpoint& out);
/// NaN is passed on; infinite values are faults.
Converted<Setpoint> from_idl(const px4_msgs::msg::TrajectorySetpoint& in);

/// The heartbeat: we control positions, with velocities and accelerations fed forward.
void to_heartbeat(double stamp_s, px4_msgs::msg::OffboardControlMode& out);

void to_idl(const VehicleState& state, px4_msgs::msg::VehicleOdometry& out);
/// Poses in NED only; velocities in NED or in the body's FRD.
Converted<VehicleState> from_idl(const px4_msgs::msg::VehicleOdometry& in);

void to_idl(const AutopilotStatus& status, px4_msgs::msg::VehicleStatus& out);
Converted<AutopilotStatus> from_idl(const px4_msgs::msg::VehicleStatus& in);

/// The pilot's sticks are there and have just been moved.
bool sticks_moved(const px4_msgs::msg::ManualControlSetpoint& in);

void to_idl(const VehicleState& state, px4_msgs::msg::VehicleLocalPosition& out);

}  // namespace foretrack
