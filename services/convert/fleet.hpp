// SPDX-License-Identifier: Apache-2.0
// What the vehicles of a fleet tell each other.
#pragma once

#include "core/fleet/fleet_member.hpp"
#include "foretrack_msgs/msg/FleetMember.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Precondition: bids as as_told() rounds them.
void to_idl(const FleetMember& member, foretrack_msgs::msg::FleetMember& out);
/// Intentions go by their names: of those that are not known here, nothing is kept.
Converted<FleetMember> from_idl(const foretrack_msgs::msg::FleetMember& in);

}  // namespace foretrack
