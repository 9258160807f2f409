// SPDX-License-Identifier: Apache-2.0
// What comes from outside: odometry, images, calibrations, the flight controller.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "services/operator/finding.hpp"
#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

/// One finding at least for each input. A map that comes from elsewhere needs no depth images.
std::vector<Finding> check_inputs(const FlightSnapshot& snapshot, bool map_comes);

/// Why nothing comes on a topic although somebody may write it: quality of service, type, or what
/// was refused, with value and expectation. None: none of these.
std::optional<Finding> check_writers(const FlightSnapshot& snapshot, const TopicFlow& flow,
                                     std::string_view stage);

}  // namespace foretrack
