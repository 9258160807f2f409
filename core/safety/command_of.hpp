// SPDX-License-Identifier: Apache-2.0
// What the gate asks of the flight controller, as a command to it.
#pragma once

#include <optional>

#include "core/safety/gate.hpp"

namespace foretrack {

/// None: nothing is asked.
std::optional<AutopilotCommand> command_of(AutopilotRequest request, int system_id);

}  // namespace foretrack
