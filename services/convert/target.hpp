// SPDX-License-Identifier: Apache-2.0
// The person: observations and the estimated state.
#pragma once

#include "core/common/target.hpp"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const TargetObservation& observation, foretrack_msgs::msg::TargetObservation& out);
/// Refuses KIND_NONE too: nothing was observed; sees_nobody() tells it apart from a fault.
Converted<TargetObservation> from_idl(const foretrack_msgs::msg::TargetObservation& in);
/// KIND_NONE: the image was looked at, and nobody was found.
void to_idl_nobody(double stamp_s, foretrack_msgs::msg::TargetObservation& out);
bool sees_nobody(const foretrack_msgs::msg::TargetObservation& in);

void to_idl(const TargetState& state, foretrack_msgs::msg::TargetState& out);
Converted<TargetState> from_idl(const foretrack_msgs::msg::TargetState& in);

}  // namespace foretrack
