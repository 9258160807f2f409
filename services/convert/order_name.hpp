// SPDX-License-Identifier: Apache-2.0
// Orders as operators and programs name them.
#pragma once

#include <optional>
#include <string_view>

#include "core/safety/mission.hpp"

namespace foretrack {

/// The order of that name ("take_off", "bounds", "follow", "framing", "return_place"); none: there
/// is no such order.
std::optional<MissionOrder> order_of(std::string_view name);

}  // namespace foretrack
