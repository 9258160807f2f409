// SPDX-License-Identifier: Apache-2.0
// What a vehicle keeps of its flights, by itself: docs/privacy.md.
#pragma once

#include "services/common/options.hpp"
#include "services/common/stop.hpp"
#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {

/// Where its recordings are.
std::string black_box_folder(const ServiceOptions& options);

/// Topics of other vehicles, and pictures, in which anybody may be, unless they are asked for.
bool is_left_out(const Channel& channel, const ServiceOptions& options);

/// Records until the stop, with the least priority on the processor and the disk. A recording that
/// ends by itself, as on a full disk, begins anew. Throws std::runtime_error if there is no folder
/// for it.
void run_black_box(const ServiceOptions& options, const std::string& parameters, Stop& stop);

}  // namespace foretrack::station
