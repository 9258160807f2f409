// SPDX-License-Identifier: Apache-2.0
// Which release of PX4 is on the bus.
#pragma once

#include <string_view>

#include "services/common/node.hpp"
#include "services/common/stop.hpp"

namespace foretrack {

/// As its topics tell: see px4_release_of. Empty: none spoke within the time, or the stop was
/// requested. Looks as a participant of its own, which leaves before it returns.
std::string_view find_px4_release(NodeOptions options, double patience_s, const Stop& stop);

/// For commands that look at the bus: what they were told, or else find. None found: stays empty.
void settle_px4_release(NodeOptions& options, const Stop& stop);

/// The topics that somebody writes.
std::string_view px4_release_on(const Node& node);

}  // namespace foretrack
