// SPDX-License-Identifier: Apache-2.0
// What an operator should know of the bus itself, a sentence each.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/common/node.hpp"
#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {

/// A sample's stamp, of a message that begins with a header, against the clock here when it came:
/// of what is stamped when it is sent, how far the sender's clock is ahead, less the way. None: it
/// has no such stamp, or one of simulated time.
std::optional<double> clock_ahead_s(const Bytes& sample, std::int64_t came_ns);

/// Clocks are by vehicle.
std::vector<std::string> warnings_of(const Node& node,
                                     const std::map<std::string, double>& clocks_ahead_s);

}  // namespace foretrack::station
