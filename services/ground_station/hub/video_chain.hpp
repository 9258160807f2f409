// SPDX-License-Identifier: Apache-2.0
// Pictures of a video need those before them, back to the last key picture.
#pragma once

#include <cstdint>
#include <span>

#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {

/// Whether a page that opens shall be shown the last picture of this topic at once.
bool is_ground_picture(const Channel& channel);

/// How a sample of this channel hangs together with those before it. Malformed videos hang together
/// with nothing: whoever shows them finds the fault.
Chain chain_of(const Channel& channel, std::span<const std::uint8_t> cdr);

}  // namespace foretrack::station
