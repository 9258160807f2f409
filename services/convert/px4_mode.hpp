// SPDX-License-Identifier: Apache-2.0
// The messages by which a mode of ours is one of the flight controller's.
#pragma once

#include <string_view>

#include "core/common/vehicle.hpp"
#include "core/safety/register_mode.hpp"
#include "px4_msgs/msg/ArmingCheckReply.h"
#include "px4_msgs/msg/ArmingCheckRequest.h"
#include "px4_msgs/msg/ModeCompleted.h"
#include "px4_msgs/msg/RegisterExtComponentReply.h"
#include "px4_msgs/msg/RegisterExtComponentRequest.h"
#include "px4_msgs/msg/UnregisterExtComponent.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Numbers of registered modes in the status (NAVIGATION_STATE_EXTERNAL1 to 8).
inline constexpr int kFirstMode = 23, kLastMode = 30;

/// As ground stations and radios show it.
inline constexpr std::string_view kModeName = "Follow";

/// `id`: by which the answer is known. `release`: as in Names.
void to_registration(std::uint64_t id, std::string_view release, double stamp_s,
                     px4_msgs::msg::RegisterExtComponentRequest& out);
/// It answers this request of ours: others register modes, too.
bool answers(const px4_msgs::msg::RegisterExtComponentReply& reply,
             const px4_msgs::msg::RegisterExtComponentRequest& request);
/// A fault: numbers that no mode has, or another version of what is agreed on about modes.
Converted<RegistrationAnswer> from_idl(const px4_msgs::msg::RegisterExtComponentReply& in,
                                       std::string_view release);

void to_unregistration(const ModeNumbers& numbers, double stamp_s,
                       px4_msgs::msg::UnregisterExtComponent& out);

/// The mode flies trajectories: it needs a local position and an attitude, and no remote control.
void to_reply(const px4_msgs::msg::ArmingCheckRequest& request, const ModeNumbers& numbers,
              bool can_run, double stamp_s, px4_msgs::msg::ArmingCheckReply& out);

void to_completed(const ModeNumbers& numbers, bool done, double stamp_s,
                  px4_msgs::msg::ModeCompleted& out);

/// Marks that the mode of that number flies, or was chosen.
void mark_own_mode(const px4_msgs::msg::VehicleStatus& in, int mode, AutopilotStatus& status);

}  // namespace foretrack
