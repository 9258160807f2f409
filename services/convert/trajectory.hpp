// SPDX-License-Identifier: Apache-2.0
// What the vehicle shall fly.
#pragma once

#include "core/common/trajectory.hpp"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Throws std::length_error beyond the bounds of the IDL.
void to_idl(const PlannedTrajectory& plan, foretrack_msgs::msg::PlannedTrajectory& out);
/// Its pieces must join: a jump of more than a centimetre or 5 cm/s is a fault.
Converted<PlannedTrajectory> from_idl(const foretrack_msgs::msg::PlannedTrajectory& in);

}  // namespace foretrack
